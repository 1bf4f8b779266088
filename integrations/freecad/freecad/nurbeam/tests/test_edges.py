"""Edges as NURBS and back."""

import Part
from FreeCAD import Vector

from ..geometry import edges, places
from .support import DocumentTest, place


def kinds():
    circle = Part.Circle(Vector(0, 0, 0), Vector(0, 0, 1), 50)
    points = [Vector(0, 0, 0), Vector(10, 5, 0), Vector(20, 0, 9), Vector(5, 8, 9)]
    spline, ring, bezier = Part.BSplineCurve(), Part.BSplineCurve(), Part.BezierCurve()
    spline.interpolate(points)
    ring.interpolate(points, PeriodicFlag=True)
    bezier.setPoles([Vector(0, 0, 0), Vector(10, 50, 0), Vector(20, 0, 9)])
    first, span = ring.FirstParameter, ring.LastParameter - ring.FirstParameter
    return {
        "circle": circle.toShape(),
        "arc": Part.ArcOfCircle(circle, 0.3, 2.2).toShape(),
        "arc over the seam": Part.ArcOfCircle(circle, 5, 7).toShape(),
        "ellipse": Part.Ellipse(Vector(0, 0, 0), 50, 20).toShape(),
        "parabola": Part.ArcOfParabola(Part.Parabola(), -3, 5).toShape(),
        "hyperbola": Part.ArcOfHyperbola(Part.Hyperbola(Vector(0, 0, 0), 5, 3), -1, 1.5).toShape(),
        "line": Part.makeLine(Vector(0, 0, 0), Vector(100, 3, 7)),
        "spline": spline.toShape(),
        "part of a spline": spline.toShape(spline.FirstParameter + 0.1, spline.LastParameter - 0.2),
        "periodic spline": ring.toShape(),
        "periodic spline over its seam": ring.toShape(first + 0.6 * span, first + 1.3 * span),
        "Bezier curve": bezier.toShape(),
        "part of a Bezier curve": bezier.toShape(0.2, 0.7),
        "helix": Part.makeHelix(10, 30, 20).Edges[0],
    }  # fmt: skip


def ends_of(edge):
    ends = edge.valueAt(edge.FirstParameter), edge.valueAt(edge.LastParameter)
    return ends[::-1] if edge.Orientation == "Reversed" else ends


class Edges(DocumentTest):
    def check(self, edge, tolerance=1e-14):
        size = max(edge.Length, edge.CenterOfMass.Length)
        spline = edges.spline_of_nurbs(edges.nurbs_of_edge(edge))
        first, last = spline.FirstParameter, spline.LastParameter
        for i in range(101):
            point = spline.value(first + (last - first) * i / 100)
            nearest = edge.Curve.value(edge.Curve.parameter(point))
            self.assertLess(point.distanceToPoint(nearest), tolerance * size)
        for point, end in zip((spline.StartPoint, spline.EndPoint), ends_of(edge)):
            self.assertLess(point.distanceToPoint(end), tolerance * size)
        self.assertAlmostEqual(spline.length() / edge.Length, 1, 7)

    def test_all_kinds_forward_reversed_and_placed_are_exact(self):
        for name, drawn in kinds().items():
            for reverse in (False, True):
                with self.subTest(kind=name, reverse=reverse):
                    edge = drawn.copy()
                    edge.Placement = place().multiply(edge.Placement)
                    if reverse:
                        edge.reverse()
                    self.check(edge)

    def test_a_mirrored_arc_is_exact(self):
        mirrored = kinds()["arc"].mirror(Vector(1, 2, 3), Vector(1, 1, 0)).Edges[0]
        self.check(mirrored)

    def test_an_edge_in_a_part_and_by_a_link_is_in_its_world_place(self):
        part = self.document.addObject("App::Part", "Part")
        drawn = self.add(kinds()["arc"], "Drawn")
        part.addObject(drawn)
        part.Placement = place()
        link = self.document.addObject("App::Link", "Link")
        link.LinkedObject = part
        link.Placement.Base = Vector(0, 0, 500)
        self.document.recompute()
        local = edges.nurbs_of_edge(kinds()["arc"])
        for root, base in ((part, place()), (link, link.Placement)):
            found = places.edges_of_link((root, ["Drawn.Edge1"]))[0]
            self.check(found)
            for got, own in zip(edges.nurbs_of_edge(found)["control_points"], local["control_points"]):
                expected = base.multVec(Vector(*own) * 1000)
                self.assertLess((Vector(*got) * 1000).distanceToPoint(expected), 1e-11)

    def test_curves_there_and_back_have_the_same_numbers_also_after_saving(self):
        nurbs = edges.nurbs_of_edge(kinds()["part of a spline"])
        self.add(edges.edge_of_nurbs(nurbs), "There")
        again = edges.nurbs_of_edge(self.reopened().getObject("There").Shape.Edges[0])
        for a, b in zip(nurbs["control_points"], again["control_points"]):
            self.assertLess(Vector(*a).distanceToPoint(Vector(*b)), 1e-15)  # m: 1e-12 mm
        for a, b in zip(nurbs["knots"], again["knots"]):
            self.assertAlmostEqual(a, b, 15)
