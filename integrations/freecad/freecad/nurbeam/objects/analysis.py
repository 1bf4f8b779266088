"""The analysis: the group that holds all parts of a model, and says what is asked of it."""

from FreeCAD import Vector

from .feature import Feature, Property, is_newer

STATES = ("Never run", "Running", "Done", "Interrupted", "Failed", "Out of date")


class Analysis(Feature):
    TYPE = "Nurbeam::Analysis"
    CONTAINER = "App::DocumentObjectGroupPython"
    PROPERTIES = (
        Property("Enumeration", "AnalysisType", "Analysis", "Kind of analysis", "Motion",
                 choices=("Motion", "Equilibrium", "Modes", "Buckling")),
        Property("Quantity", "EndTime", "Analysis", "End of a motion", "1 s", "s"),
        Property("Quantity", "Step", "Analysis", "Length of the steps of a motion; 0: adaptive, by the tolerance", "0 s", "s"),
        Property("Float", "Tolerance", "Analysis", "Local error of adaptive steps", 1e-4),
        Property("Quantity", "Every", "Analysis", "Time between stored states; 0: a hundredth of the end time", "0 s", "s"),
        Property("Enumeration", "Start", "Analysis", "State at time 0", "As drawn", choices=("As drawn", "Equilibrium")),
        Property("Integer", "LoadSteps", "Analysis", "Number of equal parts in which the loads are applied; 0: at once"),
        Property("Integer", "ModeCount", "Analysis", "Number of modes or buckling loads", 10),
        Property("Acceleration", "Gravity", "Surroundings", "Magnitude of gravity", "9.81 m/s^2"),
        Property("Vector", "GravityDirection", "Surroundings", "Direction of gravity; of any length", Vector(0, 0, -1)),
        Property("Quantity", "AirDensity", "Surroundings", "Density of the air that drags on bodies; 0: none", "0 kg/m^3", "kg/m^3"),
        Property("Speed", "Wind", "Surroundings", "Speed of the air"),
        Property("Vector", "WindDirection", "Surroundings", "Where the wind blows to; of any length", Vector(1, 0, 0)),
        Property("Path", "Folder", "Run", "Folder of the results; empty: a temporary one"),
        Property("Integer", "Threads", "Run", "Maximum number of threads; 0: one a core"),
        Property("Enumeration", "Status", "Run", "State of the last run", "Never run", choices=STATES, output=True),
        Property("String", "Message", "Run", "How the last run has ended", output=True),
    )  # fmt: skip

    def onDocumentRestored(self, obj):
        super().onDocumentRestored(obj)
        if not is_newer(obj):
            self.end_lost_run(obj)

    def end_lost_run(self, obj):
        """A run ends with its document, and redo does not bring it back."""
        from ..run.run_analysis import is_running

        if obj.Status == "Running" and not is_running(obj):
            obj.Status, obj.Message = "Interrupted", "its run is no more; run it again"

    def compute(self, obj):
        from ..case.write_case import is_same_case, written_case
        from .result import result_of

        self.end_lost_run(obj)
        result = result_of(obj)
        if result is None or obj.Status == "Running":
            return
        is_current = is_same_case(written_case(obj).text, result.CaseText)
        if obj.Status == "Done" and not is_current:
            obj.Status = "Out of date"
        elif obj.Status == "Out of date" and is_current:
            obj.Status = "Done"
