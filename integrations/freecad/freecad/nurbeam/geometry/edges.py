"""Edges of a document as NURBS curves in metres, and back.

A curve is a dictionary as the axis of a case has it: "degree", "knots" (all, ends included), "control_points" (n of
[x, y, z] in metres, not multiplied by the weights) and, where they differ, "weights".
"""

import FreeCAD
import Part

MILLIMETRES = 1000.0  # in a metre
CONICS = ("Part::GeomCircle", "Part::GeomEllipse", "Part::GeomParabola", "Part::GeomHyperbola")


def spline_of_edge(edge):
    """The edge as a `Part.BSplineCurve` that is not periodic, in its world place and in its own sense, and how far it is from
    the edge [mm]: 0 for lines, conics, Bezier curves and splines, which are exact."""
    first, last = edge.FirstParameter, edge.LastParameter
    curve = edge.Curve
    deviation = 0.0
    if curve.TypeId in CONICS:
        spline = _spline_of_conic(edge)
    elif curve.TypeId == "Part::GeomBSplineCurve":
        spline = _segment(curve, first, last)
    elif curve.TypeId == "Part::GeomBezierCurve":
        spline = _spline_of_bezier(curve, first, last)
    elif curve.TypeId == "Part::GeomLine":
        spline = curve.toBSpline(first, last)
    else:
        spline = curve.toBSpline(first, last)
        deviation = _deviation(edge, spline)
    if spline.isPeriodic():
        spline.setNotPeriodic()
    if edge.Orientation == "Reversed":
        spline.reverse()
    return spline, deviation


def _spline_of_conic(edge):
    """Quadratic and rational: `toBSpline` would be a polynomial near it."""
    forward = edge.copy()
    forward.Orientation = "Forward"
    return forward.toNurbs().Edges[0].Curve


def _spline_of_bezier(curve, first, last):
    """Cut first: `toBSpline` of a part of a Bezier curve cuts twice."""
    part = curve.copy()
    if (first, last) != (0.0, 1.0):
        part.segment(first, last)
    return part.toBSpline(0.0, 1.0)


def _segment(curve, first, last):
    spline = curve.copy()
    knots = curve.getKnots()
    if (first, last) != (knots[0], knots[-1]):
        spline.segment(first, last)
    return spline


def _deviation(edge, spline):
    count = 200
    first, last = edge.FirstParameter, edge.LastParameter
    places = [first + (last - first) * i / count for i in range(count + 1)]
    return max(edge.valueAt(u).distanceToPoint(spline.value(u)) for u in places)


def nurbs_of_spline(spline):
    """A `Part.BSplineCurve` [mm] as a curve in metres."""
    points = [[p.x / MILLIMETRES, p.y / MILLIMETRES, p.z / MILLIMETRES] for p in spline.getPoles()]
    nurbs = {"degree": spline.Degree, "knots": _all_knots(spline), "control_points": points}
    weights = spline.getWeights()
    if max(weights) - min(weights) > 1e-14 * max(weights):
        nurbs["weights"] = list(weights)
    return nurbs


def _all_knots(spline):
    pairs = zip(spline.getKnots(), spline.getMultiplicities())
    return [knot for knot, times in pairs for _ in range(times)]


def nurbs_of_edge(edge):
    """The edge as a curve in metres, in its world place and in its own sense."""
    return nurbs_of_spline(spline_of_edge(edge)[0])


def spline_of_nurbs(nurbs):
    """A curve in metres as a `Part.BSplineCurve` [mm], number by number."""
    knots, times = [], []
    for knot in nurbs["knots"]:
        if knots and knot == knots[-1]:
            times[-1] += 1
        else:
            knots.append(knot)
            times.append(1)
    poles = [FreeCAD.Vector(*(MILLIMETRES * x for x in point)) for point in nurbs["control_points"]]
    weights = nurbs.get("weights") or [1.0] * len(poles)
    spline = Part.BSplineCurve()
    spline.buildFromPolesMultsKnots(poles, times, knots, False, nurbs["degree"], list(weights))
    return spline


def edge_of_nurbs(nurbs):
    """A curve in metres as an edge [mm]."""
    return spline_of_nurbs(nurbs).toShape()
