"""Wires as one curve, and pipes as their centre line."""

import math

import Part
from FreeCAD import Placement, Rotation, Vector

from .. import objects
from ..case.axes import axis_of
from ..geometry import edges, places, wires
from ..run.pipes import NoPipe
from .support import DocumentTest, arc_wire, bent_pipe


class Wires(DocumentTest):
    def test_a_wire_with_an_arc_has_its_length(self):
        drawn = arc_wire()
        nurbs, deviation = wires.nurbs_of_edges([drawn[2], drawn[0], drawn[1]])
        spline = edges.spline_of_nurbs(nurbs)
        self.assertAlmostEqual(spline.length(), 250 + 25 * math.pi, 10)
        self.assertEqual((spline.Degree, len(nurbs["control_points"]), deviation), (2, 7, 0))
        for edge in drawn:
            for i in range(11):
                point = edge.valueAt(edge.FirstParameter + (edge.LastParameter - edge.FirstParameter) * i / 10)
                self.assertLess(spline.value(spline.parameter(point)).distanceToPoint(point), 1e-12)

    def test_edges_with_a_gap_are_refused_with_its_width(self):
        lines = [Part.makeLine(Vector(0, 0, 0), Vector(100, 0, 0)), Part.makeLine(Vector(103, 0, 0), Vector(200, 0, 0))]
        with self.assertRaisesRegex(wires.BrokenWire, "2 separate lines, the nearest 3 mm apart"):
            wires.nurbs_of_edges(lines)

    def test_a_pipe_gives_its_centre_line_and_radii(self):
        pipe = self.add(bent_pipe(), "Pipe")
        beam = objects.make(objects.Beam, self.document)
        beam.Axis = pipe
        axis = axis_of(beam)
        self.assertAlmostEqual(edges.spline_of_nurbs(axis.nurbs).length(), 250 + 25 * math.pi, 9)
        self.assertAlmostEqual(1000 * axis.radius, 10, 9)
        self.assertAlmostEqual(1000 * axis.bore, 8, 9)

    def length_of(self, link):
        beam = objects.make(objects.Beam, self.document)
        beam.Axis = link
        return edges.spline_of_nurbs(axis_of(beam).nurbs).length()

    def test_a_click_on_a_face_means_the_solid_that_it_bounds(self):
        pipe = self.add(bent_pipe(), "Pipe")
        self.assertEqual(places.whole_bodies((pipe, ["Face2", "Face5"])), [(pipe, [""])])
        self.assertEqual(places.whole_bodies((pipe, ["Edge2"])), [(pipe, ["Edge2"])])
        rods = [Part.makeCylinder(2, 100), Part.makeCylinder(3, 200, Vector(50, 0, 0))]
        part = self.document.addObject("App::Part", "Part")
        both = self.add(Part.makeCompound(rods), "Both")
        part.addObject(both)
        for i, face in enumerate(both.Shape.Faces, 1):
            link = places.whole_bodies((part, [f"{both.Name}.Face{i}"]))
            length = 200 if face.CenterOfMass.x > 25 else 100
            self.assertAlmostEqual(self.length_of(link), length, 9)
        with self.assertRaisesRegex(NoPipe, "2 different sections|2 pieces of pipe"):
            self.length_of((part, [f"{both.Name}."]))

    def test_the_faces_of_a_pipe_that_is_no_solid_give_its_centre_line(self):
        faces = [face for face in bent_pipe().Faces if face.Surface.TypeId != "Part::GeomPlane"]
        drawn = self.add(Part.makeCompound([Part.makeShell([face]) for face in faces]), "Shells")
        self.assertEqual(len(drawn.Shape.Solids), 0)
        link = places.whole_bodies((drawn, ["Face1"]))
        self.assertTrue(places.has_body(link))
        self.assertAlmostEqual(self.length_of(link), 250 + 25 * math.pi, 9)

    def test_the_outline_of_a_plane_face_is_a_line_and_no_pipe(self):
        disc = self.add(Part.Face(Part.Wire(Part.makeCircle(50))), "Disc")
        self.assertAlmostEqual(self.length_of((disc, [""])), 100 * math.pi, 9)

    def test_edges_of_several_objects_that_meet_are_one_axis(self):
        drawn = [self.add(edge, f"Piece {i}") for i, edge in enumerate(arc_wire())]
        part = self.document.addObject("App::Part", "Part")
        part.addObject(drawn[2])
        links = [(part, [f"{drawn[2].Name}.Edge1"]), (drawn[0], ["Edge1"]), (drawn[1], [""])]
        beam = objects.make(objects.Beam, self.document)
        beam.Axis = places.whole_bodies(links)
        self.document.recompute()
        self.assertAlmostEqual(beam.Length.Value, 250 + 25 * math.pi, 9)
        self.assertEqual(places.links_of(links[::-1]), places.links_of(links))
        start, first, name = axis_of(beam).nurbs["control_points"][0], drawn[0].Name, beam.Name
        beam = self.reopened().getObject(name)
        self.assertEqual(len(beam.Axis), 3)
        self.assertEqual([root.Name for root, _ in places.parts_of_link(beam.Axis)], sorted(root.Name for root, _ in beam.Axis))
        self.assertEqual(axis_of(beam).nurbs["control_points"][0], start)
        self.document.getObject(first).Shape = Part.makeLine(Vector(-50, 0, 0), Vector(100, 0, 0))
        self.document.recompute()
        self.assertAlmostEqual(beam.Length.Value, 300 + 25 * math.pi, 9)
        part = self.document.getObject("Part")
        part.Placement.Base = Vector(0, 7, 0)
        self.document.recompute()
        self.assertIn("2 separate lines, the nearest 7 mm apart", beam.getStatusString())

    def test_reversed_swaps_the_ends(self):
        beam = objects.make(objects.Beam, self.document)
        beam.Axis = (self.add(Part.Wire(arc_wire()), "Wire"), ["Edge1", "Edge2", "Edge3"])
        there = edges.spline_of_nurbs(axis_of(beam).nurbs)
        beam.Reversed = True
        back = edges.spline_of_nurbs(axis_of(beam).nurbs)
        self.assertLess(there.StartPoint.distanceToPoint(back.EndPoint), 1e-12)
        self.assertAlmostEqual(there.length(), back.length(), 9)


class Sketches(DocumentTest):
    def sketch(self):
        """Line, quarter circle, line, drawn in a sketch that stands upright and beside the origin."""
        sketch = self.document.addObject("Sketcher::SketchObject", "Sketch")
        sketch.Placement = Placement(Vector(5, 0, 0), Rotation(Vector(1, 0, 0), 90))
        circle = Part.ArcOfCircle(Part.Circle(Vector(100, 50, 0), Vector(0, 0, 1), 50), -math.pi / 2, 0)
        for piece in (Part.LineSegment(Vector(0, 0, 0), Vector(100, 0, 0)), circle, Part.LineSegment(Vector(150, 50, 0), Vector(150, 200, 0))):
            sketch.addGeometry(piece)
        self.document.recompute()
        return sketch

    def test_a_sketch_is_an_axis_as_a_whole_also_in_a_placed_part(self):
        sketch = self.sketch()
        beam = objects.make(objects.Beam, self.document)
        beam.Axis = sketch
        self.document.recompute()
        self.assertAlmostEqual(beam.Length.Value, 250 + 25 * math.pi, 9)
        part = self.document.addObject("App::Part", "Part")
        part.addObject(sketch)
        part.Placement.Base = Vector(0, 1000, 0)
        beam.Axis = (part, [f"{sketch.Name}.Edge{i}" for i in (1, 2, 3)])
        self.document.recompute()
        self.assertAlmostEqual(beam.Length.Value, 250 + 25 * math.pi, 9)
        points = axis_of(beam).nurbs["control_points"]
        self.assertTrue(all(abs(point[1] - 1) < 1e-12 for point in points))
        self.assertAlmostEqual(max(point[2] for point in points), 0.2, 12)

    def test_a_sweep_along_a_sketch_is_a_pipe(self):
        sketch = self.sketch()
        ring = self.document.addObject("Part::Feature", "Ring")
        ring.Shape = Part.Wire(Part.makeCircle(10, Vector(5, 0, 0), Vector(1, 0, 0)))
        sweep = self.document.addObject("Part::Sweep", "Sweep")
        sweep.Sections, sweep.Spine, sweep.Solid = [ring], (sketch, ["Edge1", "Edge2", "Edge3"]), True
        self.document.recompute()
        beam = objects.make(objects.Beam, self.document)
        beam.Axis, beam.SectionKind = sweep, "Of the pipe"
        self.document.recompute()
        self.assertEqual(beam.State, ["Up-to-date"], beam.getStatusString())
        self.assertAlmostEqual(beam.Length.Value, 250 + 25 * math.pi, 8)
        self.assertAlmostEqual(1000 * axis_of(beam).radius, 10, 9)
