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
        weight = ObjectsFem.makeConstraintSelfWeight(self.document)
        weight.Gravity_x, weight.Gravity_y, weight.Gravity_z = 0, -1, 0
        fem.addObject(weight)
        weighed = objects.make(objects.Analysis, self.document)
        take_over(fem, weighed)
        self.assertEqual((weighed.Gravity.getValueAs("m/s^2").Value, weighed.GravityDirection), (9.81, Vector(0, -1, 0)))
