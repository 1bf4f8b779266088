"""The zip line of the samples, drawn in FreeCAD, runs as on the command line."""

import csv
import json
import os
import subprocess

import Part

from .. import objects
from ..case.export_case import export_case
from ..run import run_analysis
from ..run.command import program
from ..run.results import nurbs_at, radii_of_beam
from ..geometry.edges import spline_of_nurbs
from .support import DocumentTest, application, zip_line

SAMPLE = os.environ.get("NURBEAM_SAMPLES", "")
END = "0.4 s"


def columns(folder):
    with open(os.path.join(folder, "histories.csv"), encoding="utf-8") as stream:
        rows = [row for row in csv.reader(stream) if row and not row[0].startswith("#")]
    return {name: [row[i] for row in rows[1:]] for i, name in enumerate(rows[0])}


class ZipLine(DocumentTest):
    def setUp(self):
        if not SAMPLE:
            self.skipTest("NURBEAM_SAMPLES names no folder")
        super().setUp()
        application()
        self.analysis = zip_line(self.document, SAMPLE, END)
        self.analysis.Folder = os.path.join(self.folder, "run")

    def run_sample(self):
        out = os.path.join(self.folder, "sample")
        case = os.path.join(SAMPLE, "zipline", "zipline.json")
        subprocess.run([program(), "run", case, "--out", out, "--quiet", "--set", "analysis.end_time=0.4",
                        "--set", "output.cad=null"], check=True, capture_output=True, timeout=60)  # fmt: skip
        return out

    def test_histories_are_the_bits_of_the_sample(self):
        run, findings = run_analysis.start_run(self.analysis)
        self.assertIsNotNone(run, findings)
        self.assertTrue(run.wait(60))
        self.assertEqual((run.code, self.analysis.Status), (0, "Done"), self.analysis.Message)
        sample, drawn = columns(self.run_sample()), columns(os.path.join(self.folder, "run", "results"))
        shared = sorted(set(sample) & set(drawn))
        self.assertGreater(len(shared), 30)
        self.assertTrue({"trolley.speed"} & {name.split(" ")[0] for name in shared}, shared)
        for name in shared:
            self.assertEqual(drawn[name], sample[name], name)
        self.exported_case_runs_alike(drawn)
        self.kept_shape_is_the_exported_one()

    def exported_case_runs_alike(self, drawn):
        path = export_case(self.analysis, os.path.join(self.folder, "exported"), with_axes=True)
        out = os.path.join(self.folder, "again")
        subprocess.run([program(), "run", path, "--out", out, "--quiet"], check=True, capture_output=True, timeout=60)
        self.assertEqual(columns(out), drawn)
        listed = subprocess.run([program(), "inspect", os.path.join(self.folder, "exported", "axes.step"), "--json"],
                                check=True, capture_output=True, text=True, timeout=30)  # fmt: skip
        self.assertEqual(json.loads(listed.stdout)[0]["curves"][0]["name"], "cable")

    def kept_shape_is_the_exported_one(self):
        result = objects.result_of(self.analysis)
        self.assertEqual(len(result.Times), 21)
        shape = objects.make(objects.DeformedShape, self.document)
        shape.Result, shape.BeamName, shape.Time = result, "cable", END
        self.document.recompute()
        file = os.path.join(self.folder, "end.brep")
        subprocess.run([program(), "export", os.path.join(self.folder, "run", "results"), "--time", "0.4", "--to", file],
                       check=True, capture_output=True, timeout=30)  # fmt: skip
        exported = Part.read(file)
        self.assertAlmostEqual(shape.Shape.Length / exported.Length, 1, 12)
        ends = [edge.valueAt(edge.LastParameter) for edge in (shape.Shape.Edges[0], exported.Edges[0])]
        self.assertLess(ends[0].distanceToPoint(ends[1]), 1e-9)
        self.solid_has_the_volume_of_its_axis(shape)

    def solid_has_the_volume_of_its_axis(self, shape):
        axis = shape.Shape.Length
        shape.Form = "Solid"
        shape.Radius, shape.Bore = radii_of_beam(shape.Result, "cable")
        self.document.recompute()
        self.assertEqual(shape.State, ["Up-to-date"], shape.getStatusString())
        self.assertTrue(shape.Shape.isValid())
        self.assertAlmostEqual(shape.Shape.Volume / (3.141592653589793 * 36 * axis), 1, 5)

    def test_a_saved_document_keeps_the_result_and_shows_it_without_the_run(self):
        run, _ = run_analysis.start_run(self.analysis)
        self.assertTrue(run.wait(60))
        before = spline_of_nurbs(nurbs_at(objects.result_of(self.analysis), "cable", 0.4)).length()
        name = self.analysis.Name
        self.analysis.Folder = ""
        self.reopened()
        analysis = self.document.getObject(name)
        self.document.recompute()
        self.assertEqual(analysis.Status, "Done")
        after = spline_of_nurbs(nurbs_at(objects.result_of(analysis), "cable", 0.4)).length()
        self.assertEqual(after, before)
        analysis.Group[0].Radius = "7 mm"
        self.document.recompute()
        self.assertEqual(analysis.Status, "Out of date")
        analysis.Group[0].Radius = "6 mm"
        self.document.recompute()
        self.assertEqual(analysis.Status, "Done")
