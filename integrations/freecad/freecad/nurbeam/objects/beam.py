"""A beam along edges of the document."""

from FreeCAD import Vector

from .feature import Feature, Property

SECTION_KINDS = ("Round", "Pipe", "Rectangle", "I", "Rope", "Profile", "Numbers", "Of the pipe")
AUTOMATIC = "Automatic"


class Beam(Feature):
    TYPE = "Nurbeam::Beam"
    PROPERTIES = (
        Property("XLinkSubList", "Axis", "Axis", "Edges, wires or sketches that meet end to end; of a solid pipe its centre line"),
        Property("Bool", "Reversed", "Axis", "The start is at the other end"),
        Property("Length", "Length", "Axis", "Of the drawn axis", output=True),
        Property("Enumeration", "SectionKind", "Section", "Its kind", "Round", choices=SECTION_KINDS),
        Property("Length", "Radius", "Section", "Outer radius, of Round and Pipe", "5 mm"),
        Property("Length", "Bore", "Section", "Inner radius, of Pipe"),
        Property("Length", "Width", "Section", "Of Rectangle and I"),
        Property("Length", "Height", "Section", "Of Rectangle and I; along the upright axis of the section"),
        Property("Length", "Flange", "Section", "Thickness of the flanges of I"),
        Property("Length", "Web", "Section", "Thickness of the web of I"),
        Property("Length", "RopeDiameter", "Section", "Over all, of Rope"),
        Property("Area", "MetallicArea", "Section", "Of all wires together, of Rope"),
        Property("Integer", "Wires", "Section", "How many, of Rope, each of which bends by itself; 0: 114"),
        Property("XLinkSub", "Profile", "Section", "A closed sketch or a face, of Profile"),
        Property("Area", "Area", "Section", "Of Numbers"),
        Property("Quantity", "SecondMoment", "Section", "Of area, of Numbers", "0 mm^4", "mm^4"),
        Property("Quantity", "SecondMomentY", "Section", "About the upright axis, of Numbers; 0: as the other", "0 mm^4", "mm^4"),
        Property("Quantity", "TorsionConstant", "Section", "St Venant's, of Numbers; 0: by the others", "0 mm^4", "mm^4"),
        Property("Length", "ExtremeFibre", "Section", "Greatest distance from the axis of bending, of Numbers; 0: no stress is given"),
        Property("Link", "Material", "Material", "A material of Arch or FEM: density, Young's modulus"),
        Property("Enumeration", "StressFree", "More", "The shape of the beam when it is free", AUTOMATIC,
                 choices=(AUTOMATIC, "As drawn", "Straight", "As drawn without torsion")),
        Property("Enumeration", "Torsion", "More", "Whether it twists", AUTOMATIC, choices=(AUTOMATIC, "Yes", "No")),
        Property("Enumeration", "Orientation", "More", "Of the upright axis of the section", AUTOMATIC,
                 choices=(AUTOMATIC, "Up", "At the start", "Centre of curvature")),
        Property("Vector", "Up", "More", "The way up of Orientation", Vector(0, 0, 1)),
        Property("Enumeration", "Corners", "More", "What a corner of the axis is", AUTOMATIC,
                 choices=(AUTOMATIC, "Error", "Smooth", "Rigid", "Hinge")),
        Property("Enumeration", "Ring", "More", "Whether the end of a closed axis is its start", AUTOMATIC,
                 choices=(AUTOMATIC, "Yes", "No")),
        Property("Bool", "Guide", "More", "A rigid curve on which bodies slide, without section and material"),
        Property("Enumeration", "LengthKind", "Length", "What is known of its length", "As drawn",
                 choices=("As drawn", "Unstressed length", "Tension")),
        Property("Length", "UnstressedLength", "Length", "When it is free"),
        Property("Force", "Tension", "Length", "As drawn"),
        Property("Quantity", "Temperature", "Length", "Above that of the unstressed length; needs thermal expansion", "0 K", "K"),
        Property("Integer", "Elements", "Mesh", "Their number; 0: as ElementTolerance asks for"),
        Property("Float", "ElementTolerance", "Mesh", "Error of positions in equilibrium over the length of the beam", 1e-5),
    )  # fmt: skip

    def compute(self, obj):
        from ..case.axes import length_of_axis

        obj.Length = length_of_axis(obj)
