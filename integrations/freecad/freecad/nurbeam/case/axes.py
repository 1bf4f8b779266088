"""The axis and the pipe of a beam."""

from ..geometry import places, wires
from ..run.pipes import pipe_of_body


class Axis:
    """Of a beam: its curve in metres, and of a pipe its radii [m]."""

    def __init__(self, nurbs, deviation=0.0, radius=0.0, bore=0.0):
        self.nurbs = nurbs
        self.deviation = deviation
        """How far the curve is from the edges [mm]."""
        self.radius = radius
        self.bore = bore


def axis_of(beam):
    """The axis of a beam. ValueError, with the reason, where nothing of use is chosen."""
    if not beam.Axis:
        raise wires.BrokenWire("no axis is chosen; choose edges, a wire, a sketch, or a pipe")
    if places.has_body(beam.Axis):
        pipe = pipe_of_body(places.body_of_link(beam.Axis))
        axis = Axis(pipe.nurbs, radius=pipe.radius, bore=pipe.bore)
    else:
        axis = Axis(*wires.nurbs_of_edges(places.edges_of_link(beam.Axis)))
    if beam.Reversed:
        axis.nurbs = reversed_nurbs(axis.nurbs)
    return axis


def reversed_nurbs(nurbs):
    """The same curve from its end to its start."""
    knots = nurbs["knots"]
    turned = dict(nurbs, control_points=nurbs["control_points"][::-1], knots=[knots[0] + knots[-1] - u for u in reversed(knots)])
    if "weights" in nurbs:
        turned["weights"] = nurbs["weights"][::-1]
    return turned


def length_of_axis(beam):
    """[mm]"""
    from ..geometry.edges import spline_of_nurbs

    return spline_of_nurbs(axis_of(beam).nurbs).length()
