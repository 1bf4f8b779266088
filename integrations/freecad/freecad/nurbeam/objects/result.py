"""What a run has left: kept in the document."""

from .feature import Feature, Property, type_of


class Result(Feature):
    TYPE = "Nurbeam::Result"
    PROPERTIES = (
        Property("LinkHidden", "Analysis", "Result", "Whose result it is"),
        Property("FileIncluded", "Data", "Result", "All stored states (netCDF)", output=True),
        Property("String", "CaseText", "Result", "The case that was run", hidden=True, output=True),
        Property("FloatList", "Times", "Result", "Of the stored states", output=True),
        Property("Integer", "Frame", "View", "The state that is shown, counted from 0", output=True),
        Property("Float", "Exaggeration", "View", "Factor on displacements", 1.0, output=True),
        Property("String", "ColourBy", "View", "The quantity that colours show", "axial_force", output=True),
        Property("Enumeration", "Show", "View", "How beams are shown", "Line", choices=("Line", "Tube"), output=True),
        Property("StringList", "Events", "Result", "What happened during the run", output=True),
        Property("StringList", "Warnings", "Result", "Of the run", output=True),
    )


def result_of(analysis):
    """The result of an analysis; None where it has none."""
    for obj in analysis.Group:
        if type_of(obj) == Result.TYPE:
            return obj
    return None
