"""A beam of a result at one time, as a shape that stays."""

from .feature import Feature, Property


class DeformedShape(Feature):
    TYPE = "Nurbeam::DeformedShape"
    CONTAINER = "Part::FeaturePython"
    PROPERTIES = (
        Property("LinkHidden", "Result", "Deformed", "The result that it is taken of"),
        Property("String", "BeamName", "Deformed", "The beam, by its name in the case"),
        Property("Quantity", "Time", "Deformed", "Time of the shape; the nearest stored state is taken", "0 s", "s"),
        Property("Float", "Exaggeration", "Deformed", "Factor on displacements", 1.0),
        Property("Enumeration", "Form", "Deformed", "The axis alone, or a solid with a round section", "Curve", choices=("Curve", "Solid")),
        Property("Length", "Radius", "Deformed", "Outer radius of the solid"),
        Property("Length", "Bore", "Deformed", "Inner radius of the solid"),
    )

    def compute(self, obj):
        from ..run.results import deformed_shape

        obj.Shape = deformed_shape(obj)
