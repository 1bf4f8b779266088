"""What is taken over of a FEM analysis."""

import Part
from FreeCAD import Vector

from .. import objects
from ..case.write_case import written_case
from ..fem.take_over import fem_analyses, take_over
from .support import DocumentTest


class Fem(DocumentTest):
    def test_beams_supports_forces_and_material_are_taken_over(self):
        try:
            import ObjectsFem
        except ImportError:
            self.skipTest("FreeCAD has no FEM")
        bar = self.add(Part.makeLine(Vector(0, 0, 0), Vector(1000, 0, 0)), "Bar")
        fem = ObjectsFem.makeAnalysis(self.document, "FEM")
        section = ObjectsFem.makeElementGeometry1D(self.document, sectiontype="Circular", width=20, height=20)
        section.References, section.CircDiameter = [(bar, "Edge1")], "20 mm"
        card = ObjectsFem.makeMaterialSolid(self.document, "Steel")
        card.Material = {"Name": "Steel", "Density": "7900 kg/m^3", "YoungsModulus": "200000 MPa"}
        fixed = ObjectsFem.makeConstraintFixed(self.document)
        fixed.References = [(bar, "Vertex1")]
        force = ObjectsFem.makeConstraintForce(self.document)
        force.References, force.Force = [(bar, "Vertex2")], 25.0
        for each in (section, card, fixed, force):
            fem.addObject(each)
        self.document.recompute()
        self.assertEqual(fem_analyses(self.document), [fem])
        analysis = objects.make(objects.Analysis, self.document)
        made, notes = take_over(fem, analysis)
        self.document.recompute()
        self.assertEqual(notes, [])
        self.assertEqual(analysis.Gravity.Value, 0)
        beam, support, load = made
        self.assertEqual((beam.SectionKind, beam.Radius.Value, beam.Material), ("Round", 10, card))
        self.assertEqual((support.SupportKind, support.Beam), ("Clamped", beam))
        self.assertAlmostEqual(load.Force.getValueAs("N").Value, 25, 9)
        case = written_case(analysis)
        self.assertEqual(case.faults, [])
        self.assertEqual(case.keys["beams"][0]["material"], {"density": 7900, "youngs_modulus": 2e11})
        self.assertEqual(case.keys["supports"][0]["at"], {"near": [0, 0, 0]})
        self.assertEqual(case.keys["loads"][0]["at"], {"near": [1, 0, 0]})
        self.the_rest_is_noted(ObjectsFem, fem, section)
        weight = ObjectsFem.makeConstraintSelfWeight(self.document)
        weight.Gravity_x, weight.Gravity_y, weight.Gravity_z = 0, -1, 0
        fem.addObject(weight)
        weighed = objects.make(objects.Analysis, self.document)
        take_over(fem, weighed)
        self.assertEqual((weighed.Gravity.getValueAs("m/s^2").Value, weighed.GravityDirection), (9.81, Vector(0, -1, 0)))

    def the_rest_is_noted(self, fem_objects, fem, section):
        """A constraint that is not known, and a section without references where there is no mesh."""
        pressure = fem_objects.makeConstraintPressure(self.document)
        fem.addObject(pressure)
        references, section.References = section.References, []
        made, notes = take_over(fem, objects.make(objects.Analysis, self.document))
        self.assertEqual(made, [])
        self.assertTrue(any("Pressure" in note and "not taken over" in note for note in notes), notes)
        self.assertTrue(any("refers to no edge" in note for note in notes), notes)
        section.References = references
        fem.removeObject(pressure)

    def test_a_section_without_references_is_of_all_edges_each_with_its_own_material(self):
        try:
            import ObjectsFem
        except ImportError:
            self.skipTest("FreeCAD has no FEM")
        corner = Vector(1000, 0, 0)
        frame = self.add(Part.makePolygon([Vector(0, 0, 0), corner, corner + Vector(0, 0, 500)]), "Frame")
        fem = ObjectsFem.makeAnalysis(self.document, "FEM")
        section = ObjectsFem.makeElementGeometry1D(self.document, sectiontype="Pipe")
        section.PipeDiameter, section.PipeThickness = "20 mm", "2 mm"
        mesh = ObjectsFem.makeMeshGmsh(self.document)
        mesh.Part = frame
        steel, brass = (ObjectsFem.makeMaterialSolid(self.document, name) for name in ("Steel", "Brass"))
        for card, modulus in ((steel, "200000 MPa"), (brass, "100000 MPa")):
            card.Material = {"Name": card.Label, "Density": "8000 kg/m^3", "YoungsModulus": modulus}
        brass.References = [(frame, "Edge2")]
        for each in (section, mesh, steel, brass):
            fem.addObject(each)
        made, notes = take_over(fem, objects.make(objects.Analysis, self.document))
        self.assertEqual(notes, [])
        self.assertEqual([beam.Material for beam in made], [steel, brass])
        self.assertEqual([(beam.SectionKind, beam.Radius.Value, beam.Bore.Value) for beam in made], [("Pipe", 10, 8)] * 2)
