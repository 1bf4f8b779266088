"""Cases with every kind of part: nurbeam takes them as they are written."""

import Part
from FreeCAD import Vector

from .. import objects
from ..case.write_case import written_case
from ..run import run_analysis
from .support import DocumentTest, application, cantilever, material


class Parts(DocumentTest):
    def setUp(self):
        super().setUp()
        application()
        self.analysis, self.beam, self.support, self.load = cantilever(self.document)

    def part(self, cls, label):
        return objects.make(cls, self.document, label, self.analysis)

    def sheet(self, cells):
        sheet = self.document.addObject("Spreadsheet::Sheet", "Table")
        for cell, content in cells.items():
            sheet.set(cell, content)
        self.document.recompute()
        return sheet

    def check(self):
        case, findings = run_analysis.check(self.analysis)
        self.assertEqual([f for f in findings if f.severity == "error"], [])
        return case.keys

    def beam_on(self, label, start, end):
        line = self.add(Part.makeLine(start, end), f"Line {label}")
        beam = self.part(objects.Beam, label)
        beam.Axis, beam.Radius, beam.Material, beam.Elements = (line, ["Edge1"]), "5 mm", material(self.document), 8
        return beam

    def test_bodies_a_connector_and_stops(self):
        self.analysis.AnalysisType = "Motion"
        bodies = []
        for i, at in enumerate((0.2, 0.6)):
            body = self.part(objects.SlidingBody, f"body {i}")
            body.Beam, body.PlaceKind, body.Fraction, body.Mass, body.Friction = self.beam, "Fraction", at, "2 kg", 0.1
            bodies.append(body)
        spring = self.part(objects.Connector, "spring")
        spring.FromObject, spring.ToObject, spring.Stiffness, spring.Damping = bodies[0], bodies[1], "2 N/mm", "3 N*s/m"
        stop = self.part(objects.Stop, "stop")
        stop.Beam, stop.PlaceKind, stop.Fraction, stop.Restitution = self.beam, "Fraction", 0.9, 0.5
        between = self.part(objects.Stop, "between")
        between.Beam, between.BetweenBodies, between.Bodies, between.StopKind = self.beam, True, bodies, "Buffer"
        between.Gap = "20 mm"
        keys = self.check()
        self.assertEqual(keys["connectors"][0]["from"], {"body": "body 0"})
        self.assertEqual(keys["connectors"][0]["stiffness"], 2000)
        self.assertEqual(keys["stops"][1]["bodies"], ["body 0", "body 1"])
        self.assertEqual(keys["sliding_joints"][0]["friction"], {"coefficient": 0.1})

    def test_a_rigid_joint_and_a_spring_to_a_point(self):
        other = self.beam_on("other", Vector(1000, 0, 0), Vector(1000, 0, 500))
        joint = self.part(objects.Joint, "corner")
        joint.Beams, joint.JointKind = [self.beam, other], "Rigid"
        spring = self.part(objects.Connector, "spring")
        spring.FromObject, spring.FromPlaceKind = other, "End"
        spring.ToPoint = (self.add(Part.Vertex(1500, 0, 500), "Point"), ["Vertex1"])
        keys = self.check()
        self.assertEqual((joint.Position, spring.FromPosition, spring.ToPosition),
                         (Vector(1000, 0, 0), Vector(1000, 0, 500), Vector(1500, 0, 500)))  # fmt: skip
        self.assertEqual(keys["joints"][0]["beams"], ["bar", "other"])
        self.assertEqual(keys["connectors"][0]["to"], {"point": [1.5, 0, 0.5]})

    def test_a_rotational_spring_between_beams_and_one_with_masses(self):
        other = self.beam_on("other", Vector(1000, 0, 0), Vector(1000, 0, 500))
        joint = self.part(objects.Joint, "corner")
        joint.Beams = [self.beam, other]
        spring = self.part(objects.Connector, "spring")
        spring.FromObject, spring.FromPlaceKind, spring.ToObject = self.beam, "End", other
        spring.ConnectorKind, spring.RotationalStiffness, spring.RotationAxis = "Rotational", "50 N*m/rad", Vector(0, 1, 0)
        spring.FreeAngle, spring.Moment, spring.FromMass = "-30 deg", "2 N*m", "0.5 kg"  # a mass is of the others
        self.document.recompute()
        keys = self.check()["connectors"][0]
        wanted = {"type": "rotational", "stiffness": 50, "axis": [0, 1, 0], "angle": -30, "moment": 2}
        self.assertEqual({key: keys[key] for key in wanted}, wanted)
        self.assertFalse({"length", "end_masses"} & set(keys))
        spring.ConnectorKind = "Spring"
        self.assertEqual(self.check()["connectors"][0]["end_masses"], [0.5, 0])

    def test_extra_keys_reach_bodies_their_joints_and_probes(self):
        self.analysis.AnalysisType, self.analysis.AirDensity = "Motion", "1.2 kg/m^3"
        body = self.part(objects.SlidingBody, "body")
        body.Beam, body.PlaceKind = self.beam, "Fraction"
        body.ExtraKeys = '{"drag_area": 0.3, "carried_as": "point"}'
        probe = self.part(objects.Probe, "probe")
        probe.Beam, probe.ExtraKeys = self.beam, '{"at": {"fraction": 0.25}}'
        keys = self.check()
        self.assertEqual(keys["bodies"][0]["drag_area"], 0.3)
        self.assertNotIn("drag_area", keys["sliding_joints"][0])
        self.assertEqual(keys["sliding_joints"][0]["carried_as"], "point")
        self.assertEqual(keys["output"]["probes"][0]["at"], {"fraction": 0.25})

    def test_parts_of_one_name_are_told_apart_and_noted(self):
        import FreeCAD

        general = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Document")
        before = general.GetBool("DuplicateLabels", False)
        general.SetBool("DuplicateLabels", True)
        try:
            other = self.beam_on("bar", Vector(0, 0, 900), Vector(500, 0, 900))
        finally:
            general.SetBool("DuplicateLabels", before)
        support = self.part(objects.Support, "other wall")
        support.Beam = other
        case, findings = run_analysis.check(self.analysis)
        self.assertEqual([item["name"] for item in case.keys["beams"]], ["bar", f"bar ({other.Name})"])
        notes = [(f.obj, f.message) for f in findings if f.severity == "note"]
        self.assertIn((other, f'another one has this name, too; results name this one "bar ({other.Name})"'), notes)

    def test_tables_of_a_support_and_a_load(self):
        self.analysis.AnalysisType = "Motion"
        moves = self.sheet({"A1": "s", "B1": "mm", "C1": "mm", "D1": "mm", "A2": "0", "B2": "0", "C2": "0", "D2": "0",
                            "A3": "1", "B3": "0", "C3": "0", "D3": "20"})  # fmt: skip
        self.support.Table, self.support.Range = moves, "A1:D3"
        factors = self.sheet({"A1": "s", "B1": "1", "A2": "0", "B2": "0", "A3": "0.5", "B3": "1"})
        self.load.Table, self.load.Range = factors, "A1:B3"
        keys = self.check()
        self.assertEqual(keys["supports"][0]["motion"], [[0, 0, 0, 0], [1, 0, 0, 0.02]])
        self.assertEqual(keys["loads"][0]["time"], [[0, 0], [0.5, 1]])

    def test_a_recompute_checks_what_objects_link_to(self):
        """Before any check or run: a link that is gone, or leads to something else, is told at its object."""
        sheet = self.sheet({"A1": "s", "B1": "mm", "A2": "0", "B2": "0"})
        joint, spring = self.part(objects.Joint, "joint"), self.part(objects.Connector, "spring")
        spring.FromObject = self.beam
        plane = self.add(Part.makeBox(1, 1, 1), "Box")
        for obj, changes, message in (
            (self.support, {"Beam": None}, "Beam: no beam is chosen"),
            (self.support, {"Beam": self.load}, f"Beam: {self.load.Label} is no beam"),
            (self.support, {"Beam": self.beam, "Table": sheet, "Range": "A1:B2"}, "Range: A1:B2 has 2 columns; expected 4"),
            (self.load, {"PlaceKind": "At a point"}, "choose one point"),
            (self.load, {"PlaceKind": "End", "DirectionOf": (plane, ["Vertex1"])}, "DirectionOf: a vertex has no direction"),
            (joint, {"Beams": [self.beam]}, "Beams: 1 beams are chosen; expected 2"),
            (spring, {}, "ToObject: nothing is chosen"),
            (spring, {"ToObject": plane}, "ToObject: Box is neither a beam nor a sliding body"),
        ):
            with self.subTest(message=message):
                for name, value in changes.items():
                    setattr(obj, name, value)
                self.document.recompute()
                self.assertIn("Invalid", obj.State)
                self.assertIn(message, obj.getStatusString())
        self.support.Table, self.load.DirectionOf = None, None
        self.document.recompute()
        self.assertEqual((self.support.State, self.load.State), (["Up-to-date"], ["Up-to-date"]))

    def test_all_kinds_of_sections(self):
        profile = self.add(Part.Wire(Part.makePolygon([Vector(0, 0, 0), Vector(20, 0, 0), Vector(20, 30, 0), Vector(0, 30, 0), Vector(0, 0, 0)])), "Profile")
        sizes = {
            "Round": {"Radius": "5 mm"},
            "Pipe": {"Radius": "6 mm", "Bore": "4 mm"},
            "Rectangle": {"Width": "20 mm", "Height": "30 mm"},
            "I": {"Width": "50 mm", "Height": "80 mm", "Flange": "6 mm", "Web": "4 mm"},
            "Rope": {"RopeDiameter": "16 mm", "MetallicArea": "110 mm^2"},
            "Numbers": {"Area": "100 mm^2", "SecondMoment": "2000 mm^4", "ExtremeFibre": "5 mm"},
            "Profile": {"Profile": (profile, ["Edge1", "Edge2", "Edge3", "Edge4"])},
        }
        for kind, values in sizes.items():
            with self.subTest(kind=kind):
                self.beam.SectionKind = kind
                for name, value in values.items():
                    setattr(self.beam, name, value)
                section = self.check()["beams"][0]["section"]
                if kind == "Numbers":
                    self.assertEqual(section, {"area": 1e-4, "second_moment": 2e-9, "extreme_fibre": 0.005})

    def test_a_profile_that_is_changed_is_another_case(self):
        profile = self.add(Part.Wire(Part.makeCircle(5)), "Profile")
        self.beam.SectionKind, self.beam.Profile = "Profile", (profile, ["Edge1"])
        before = written_case(self.analysis).keys
        profile.Shape = Part.Wire(Part.makeCircle(6))
        self.assertNotEqual(before["beams"][0]["section"], written_case(self.analysis).keys["beams"][0]["section"])

    def test_modes_and_buckling_run(self):
        self.load.Direction = Vector(-1, 0, 0)
        for kind in ("Modes", "Buckling"):
            self.analysis.AnalysisType, self.analysis.ModeCount = kind, 2
            run, findings = run_analysis.start_run(self.analysis)
            self.assertIsNotNone(run, findings)
            self.assertTrue(run.wait(60))
            self.assertEqual(self.analysis.Status, "Done", self.analysis.Message)
            self.assertGreater(len(objects.result_of(self.analysis).Times), 1)
