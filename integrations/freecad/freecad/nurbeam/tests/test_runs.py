"""Faults at their objects; runs that end well, are stopped, or are killed."""

import os

from .. import objects
from ..run import run_analysis
from .support import DocumentTest, application, cantilever


class Faults(DocumentTest):
    def setUp(self):
        super().setUp()
        application()
        self.analysis, self.beam, self.support, self.load = cantilever(self.document)

    def errors(self):
        _, findings = run_analysis.check(self.analysis)
        return [(f.obj, f.prop) for f in findings if f.severity == "error"]

    def expect(self, obj, prop):
        self.assertIn((obj, prop), self.errors())
        self.assertIn("Invalid", obj.State)
        self.assertIn(prop, obj.getStatusString())

    def test_a_sound_model_has_no_errors(self):
        self.assertEqual(self.errors(), [])
        self.assertEqual(self.beam.State, ["Up-to-date"])

    def test_what_freecad_knows_is_told_before_nurbeam_is_asked(self):
        self.beam.Material = None
        self.expect(self.beam, "Material")
        self.support.Beam = None
        self.expect(self.support, "Beam")

    def test_what_nurbeam_says_is_told_at_object_and_property(self):
        self.beam.Radius = 0
        self.expect(self.beam, "Radius")
        self.beam.Radius = "5 mm"
        self.assertEqual(self.errors(), [])
        self.load.PlaceKind, self.load.PlaceLength = "Length", "3 m"
        self.expect(self.load, "PlaceLength")
        self.load.PlaceKind = "End"
        self.beam.ExtraKeys = '{"no_such_key": 1}'
        self.expect(self.beam, "ExtraKeys")

    def test_a_joint_a_connector_a_stop_and_the_analysis(self):
        import Part
        from FreeCAD import Vector

        other = objects.make(objects.Beam, self.document, "other", self.analysis)
        other.Axis, other.Material = (self.add(Part.makeLine(Vector(0, 9, 0), Vector(900, 9, 0))), ["Edge1"]), self.beam.Material
        joint = objects.make(objects.Joint, self.document, "joint", self.analysis)
        joint.Beams = [self.beam, other]  # which meet nowhere
        connector = objects.make(objects.Connector, self.document, "connector", self.analysis)
        connector.FromObject, connector.ToObject, connector.ToPlaceKind, connector.ToPlaceLength = self.beam, other, "Length", "2 m"
        self.expect(joint, "Beams")
        self.document.removeObject(joint.Name)
        self.expect(connector, "ToPlaceLength")
        self.document.removeObject(connector.Name)
        stop = objects.make(objects.Stop, self.document, "stop", self.analysis)
        stop.Beam, stop.Restitution = self.beam, 3
        self.expect(stop, "Restitution")
        self.document.removeObject(stop.Name)
        self.analysis.AnalysisType, self.analysis.EndTime = "Motion", "0 s"
        self.expect(self.analysis, "EndTime")

    def test_a_place_outside_of_a_support_a_body_and_a_probe(self):
        body = objects.make(objects.SlidingBody, self.document, "body", self.analysis)
        probe = objects.make(objects.Probe, self.document, "probe", self.analysis)
        self.analysis.AnalysisType = "Motion"
        for obj in (self.support, body, probe):
            obj.Beam = self.beam
        for obj in (self.support, body, probe):
            obj.PlaceKind, obj.PlaceLength = "Length", "3 m"
            self.expect(obj, "PlaceLength")
            obj.PlaceKind = "Start"
        body.Mass = 0
        self.expect(body, "Mass")

    def test_a_zero_direction_and_broken_json_are_told(self):
        from FreeCAD import Vector

        self.load.Direction = Vector(0, 0, 0)
        self.expect(self.load, "Direction")
        self.load.Direction = Vector(0, 0, -1)
        self.load.ExtraKeys = "{"
        self.expect(self.load, "ExtraKeys")

    def test_a_value_that_is_mended_is_no_longer_complained_of(self):
        self.beam.Radius = 0
        self.expect(self.beam, "Radius")
        self.beam.Radius = "5 mm"
        self.document.recompute()
        self.assertEqual(self.beam.State, ["Up-to-date"])


class Runs(DocumentTest):
    def setUp(self):
        super().setUp()
        application()
        self.analysis, self.beam, self.support, self.load = cantilever(self.document)

    def begin(self):
        run, findings = run_analysis.start_run(self.analysis)
        self.assertIsNotNone(run, findings)
        return run

    def make_long(self):
        """A motion that takes minutes."""
        self.analysis.AnalysisType, self.analysis.EndTime, self.analysis.Step = "Motion", "1000 s", "0.0002 s"
        self.analysis.Every = "0.01 s"

    def test_an_equilibrium_is_that_of_the_closed_form(self):
        run = self.begin()
        self.assertTrue(run.wait(60))
        self.assertEqual(self.analysis.Status, "Done", self.analysis.Message)
        result = objects.result_of(self.analysis)
        shape = objects.make(objects.DeformedShape, self.document)
        shape.Result = result
        self.document.recompute()
        edge = shape.Shape.Edges[0]
        sag = -edge.valueAt(edge.LastParameter).z
        # F L^3 / (3 EI) of small bending; large bending is less by (4/35) (F L^2 / EI)^2.
        stiffness = 210e9 * 3.141592653589793 * 0.005**4 / 4
        small, ratio = 1000 * 10 / (3 * stiffness), 10 / stiffness
        self.assertAlmostEqual(sag / (small * (1 - 4 / 35 * ratio**2)), 1, 3)
        phases = [line.phase for line in run.lines if line.phase]
        self.assertEqual(phases[-1], "ended")
        self.assertIn("equilibrium", phases)
        self.assertEqual(run_analysis.Run.running, {})

    def test_a_run_that_ends_before_its_first_state_leaves_the_result_before(self):
        self.assertTrue(self.begin().wait(60))
        result = objects.result_of(self.analysis)
        before = (result.Times, result.CaseText)
        self.analysis.AnalysisType = "Buckling"  # of a bar that is only bent
        self.assertTrue(self.begin().wait(60))
        self.assertEqual((self.analysis.Status, result.Times, result.CaseText), ("Failed", *before))
        self.assertIn("nothing buckles", self.analysis.Message)

    def test_modes_are_told_with_their_frequencies(self):
        self.analysis.AnalysisType, self.analysis.ModeCount = "Modes", 2
        self.assertTrue(self.begin().wait(60))
        result = objects.result_of(self.analysis)
        # (1.87510407 / L)^2 sqrt(EI / (rho A)) / (2 pi) of a cantilever, its second with 4.69409113.
        wave = (210e9 * 0.005**2 / 4 / 7850) ** 0.5 / (2 * 3.141592653589793)
        for text, number, root in zip(result.Events, (1, 2), (1.87510407, 4.69409113)):
            name, frequency, unit = text.rsplit(" ", 2)
            self.assertEqual((name, unit), (f"mode {number}:", "Hz"))
            self.assertLess(abs(float(frequency) / (root**2 * wave) - 1), 2e-3)

    def test_a_folder_that_cannot_be_written_is_told(self):
        self.analysis.Folder = os.path.join(os.devnull, "nowhere")
        run, findings = run_analysis.start_run(self.analysis)
        self.assertIsNone(run)
        self.assertEqual((findings[-1].obj, findings[-1].prop), (self.analysis, "Folder"))
        self.assertEqual((self.analysis.Status, run_analysis.Run.running), ("Never run", {}))

    def test_a_wrong_extra_key_does_not_disturb_a_recompute(self):
        self.assertTrue(self.begin().wait(60))
        self.analysis.ExtraKeys = '{"gravity": 3}'
        self.document.recompute()
        self.assertEqual((self.analysis.Status, self.analysis.getStatusString()), ("Out of date", "Valid"))

    def test_undo_of_a_run_leads_back_to_what_was_before(self):
        self.document.UndoMode = 1
        run = self.begin()
        self.assertEqual(self.analysis.Status, "Running")
        again, findings = run_analysis.start_run(self.analysis)
        self.assertIsNone(again)
        self.assertIn("running already", findings[0].message)
        self.assertTrue(run.wait(60))
        self.assertEqual((self.analysis.Status, self.document.UndoNames[0]), ("Done", "Run"))
        self.document.undo()
        self.assertEqual((self.analysis.Status, objects.result_of(self.analysis)), ("Never run", None))
        self.document.redo()
        self.assertEqual(self.analysis.Status, "Done")
        self.assertEqual(len(objects.result_of(self.analysis).Times), 1)

    def test_a_document_that_was_saved_during_a_run_is_not_running(self):
        self.make_long()
        run = self.begin()
        self.assertEqual(self.analysis.Status, "Running")
        name = self.analysis.Name
        analysis = self.reopened().getObject(name)
        self.assertEqual(analysis.Status, "Interrupted")
        run.kill()
        self.assertTrue(run.wait(20))
        self.assertEqual((analysis.Status, run_analysis.Run.running), ("Interrupted", {}))

    def test_a_run_that_is_stopped_keeps_its_results_until_then(self):
        self.make_long()
        run = self.begin()
        with self.assertRaises(RuntimeError):
            run_analysis.Run(self.analysis, run.case).start()
        while not any(line.phase == "motion" and line.time for line in run.lines):
            self.assertFalse(run.wait(0.2), self.analysis.Message)
        run.stop()
        self.assertTrue(run.wait(20))
        self.assertEqual((run.code, self.analysis.Status), (130, "Interrupted"))
        times = objects.result_of(self.analysis).Times
        self.assertGreater(len(times), 1)
        self.assertLess(times[-1], 1000)

    def test_a_run_that_is_killed_leaves_the_document_as_it_was(self):
        self.make_long()
        run = self.begin()
        before = [obj.Name for obj in self.document.Objects]
        run.wait(0.5)
        run.kill()
        self.assertTrue(run.wait(20))
        self.assertEqual((run.code, self.analysis.Status), (-1, "Failed"))
        self.assertIn("killed", self.analysis.Message)
        self.assertEqual([obj.Name for obj in self.document.Objects], before)
        self.assertFalse(os.path.exists(run.folder))

    def test_two_analyses_run_side_by_side(self):
        self.make_long()
        other, *_ = cantilever(self.document)
        first = self.begin()
        second, findings = run_analysis.start_run(other)
        self.assertIsNotNone(second, findings)
        self.assertEqual(len(run_analysis.Run.running), 2)
        self.assertTrue(second.wait(60))
        self.assertEqual((second.code, first.code, self.analysis.Status), (0, None, "Running"))
        first.kill()
        self.assertTrue(first.wait(20))

    def test_a_run_is_one_step_of_undo(self):
        self.document.UndoMode = 1
        run = self.begin()
        self.assertTrue(run.wait(60))
        self.assertIsNotNone(objects.result_of(self.analysis))
        self.assertEqual(self.document.UndoNames[0], "Run")
        self.document.undo()
        self.assertIsNone(objects.result_of(self.analysis))

    def test_results_wait_while_something_is_edited(self):
        self.document.UndoMode = 1
        run = self.begin()
        self.document.openTransaction("Edit")
        run_analysis.edited_documents.add(self.document.Name)  # as a panel does
        self.load.Force = "20 N"
        self.assertFalse(run.wait(3))
        self.document.abortTransaction()
        run_analysis.edited_documents.clear()
        self.assertTrue(run.wait(20))
        self.assertEqual(self.load.Force.getValueAs("N").Value, 10)
        self.assertEqual(self.analysis.Status, "Done")
        self.assertIsNotNone(objects.result_of(self.analysis))

    def test_a_missing_command_is_told_with_the_package_that_has_it(self):
        from unittest import mock

        with mock.patch.dict(os.environ, {"NURBEAM_COMMAND": "", "PATH": "/nowhere"}):
            run, findings = run_analysis.start_run(self.analysis)
        self.assertIsNone(run)
        self.assertIn("install the package nurbeam", findings[0].message)

    def test_a_document_that_is_closed_ends_its_runs(self):
        import FreeCAD

        self.make_long()
        run = self.begin()
        run_analysis.stop_runs_of(self.document)
        FreeCAD.closeDocument(self.document.Name)
        self.assertTrue(run.wait(20))
        self.assertEqual(run.code, -1)
