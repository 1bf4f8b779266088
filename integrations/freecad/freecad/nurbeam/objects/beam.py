"""A beam along edges of the document."""

from FreeCAD import Vector

from .feature import Feature, Property

SECTION_KINDS = ("Round", "Pipe", "Rectangle", "I", "Rope", "Profile", "Numbers", "Of the pipe")
AUTOMATIC = "Automatic"


class Beam(Feature):
    TYPE = "Nurbeam::Beam"
    PROPERTIES = (
        Property("XLinkSubList", "Axis", "Axis", "Edges, wires or sketches that meet end to end; of a solid pipe its centre line"),
        Property("Bool", "Reversed", "Axis", "Exchanges start and end"),
        Property("Length", "Length", "Axis", "Length of the axis", output=True),
        Property("Enumeration", "SectionKind", "Section", "How the section is given", "Round", choices=SECTION_KINDS),
        Property("Length", "Radius", "Section", "Outer radius", "5 mm"),
        Property("Length", "Bore", "Section", "Inner radius"),
        Property("Length", "Width", "Section", "Across the upright axis of the section"),
        Property("Length", "Height", "Section", "Along the upright axis of the section"),
        Property("Length", "Flange", "Section", "Thickness of the flanges"),
        Property("Length", "Web", "Section", "Thickness of the web"),
        Property("Length", "RopeDiameter", "Section", "Of the rope over all"),
        Property("Area", "MetallicArea", "Section", "Area of all wires together"),
        Property("Integer", "Wires", "Section", "Number of wires, each of which bends by itself; 0: 114"),
        Property("XLinkSub", "Profile", "Section", "A closed sketch or a face"),
        Property("Area", "Area", "Section", "Area of the section"),
        Property("Quantity", "SecondMoment", "Section", "Second moment of area", "0 mm^4", "mm^4"),
        Property("Quantity", "SecondMomentY", "Section", "Second moment of area about the upright axis; 0: as the other", "0 mm^4", "mm^4"),
        Property("Quantity", "TorsionConstant", "Section", "St Venant's torsion constant; 0: that of a round section", "0 mm^4", "mm^4"),
        Property("Length", "ExtremeFibre", "Section", "Maximum distance of the section from its axis of bending; 0: no stress is computed"),
        Property("Link", "Material", "Material", "A material card of the document, or one that FreeCAD brings"),
        Property("Enumeration", "StressFree", "More", "Shape of the beam without stress", AUTOMATIC,
                 choices=(AUTOMATIC, "As drawn", "Straight", "As drawn without torsion")),
        Property("Enumeration", "Torsion", "More", "Whether the beam twists", AUTOMATIC, choices=(AUTOMATIC, "Yes", "No")),
        Property("Enumeration", "Orientation", "More", "Direction of the upright axis of the section", AUTOMATIC,
                 choices=(AUTOMATIC, "Up", "At the start", "Centre of curvature")),
        Property("Vector", "Up", "More", "Direction of the upright axis; of any length", Vector(0, 0, 1)),
        Property("Enumeration", "Corners", "More", "Treatment of a corner of the axis", AUTOMATIC,
                 choices=(AUTOMATIC, "Error", "Smooth", "Rigid", "Hinge")),
        Property("Enumeration", "Ring", "More", "Whether the end of a closed axis is joined to its start", AUTOMATIC,
                 choices=(AUTOMATIC, "Yes", "No")),
        Property("Bool", "Guide", "More", "A rigid curve on which bodies slide, without section and material"),
        Property("Enumeration", "LengthKind", "Length", "What is known of the length", "As drawn",
                 choices=("As drawn", "Unstressed length", "Tension")),
        Property("Length", "UnstressedLength", "Length", "Length without stress"),
        Property("Force", "Tension", "Length", "Axial force in the reference configuration"),
        Property("Quantity", "Temperature", "Length", "Above that of the unstressed length; the material needs a thermal expansion", "0 K", "K"),
        Property("Integer", "Elements", "Mesh", "Number of elements; 0: as many as the tolerance needs"),
        Property("Float", "ElementTolerance", "Mesh", "Error of positions in equilibrium over the length of the beam", 1e-5),
    )  # fmt: skip

    def compute(self, obj):
        from ..case.axes import length_of_axis

        obj.Length = length_of_axis(obj)
