"""Several edges that meet end to end as one curve."""

import Part

from .edges import nurbs_of_spline, spline_of_edge


class BrokenWire(ValueError):
    """Edges that are no single line from one end to the other; the text says why."""


def ordered_edges(edges):
    """The edges from one end to the other, each in the sense of the way. BrokenWire where they are not one line."""
    if not edges:
        raise BrokenWire("no edge is chosen; choose edges, a wire or a sketch")
    chains = Part.sortEdges(list(edges))
    if len(chains) > 1:
        gap = min(_distance(a, b) for i, a in enumerate(chains) for b in chains[i + 1 :])
        raise BrokenWire(f"the edges are {len(chains)} separate lines, the nearest {gap:.6g} mm apart; "
                         "close the gaps, or make a beam of each line")  # fmt: skip
    wire = Part.Wire(chains[0])
    return list(wire.OrderedEdges) if len(wire.OrderedEdges) == len(chains[0]) else chains[0]


def _distance(chain, other):
    ends = [[v.Point for edge in edges for v in edge.Vertexes] for edges in (chain, other)]
    return min(a.distanceToPoint(b) for a in ends[0] for b in ends[1])


def nurbs_of_edges(edges):
    """One curve in metres along all the edges, and how far it is from them [mm].

    Degrees are raised to the highest, weights scaled so that they agree at joints, whose knots have the multiplicity of the
    degree: the points are those of the edges, exactly."""
    pairs = [spline_of_edge(edge) for edge in ordered_edges(edges)]
    splines = _head_to_tail([spline for spline, _ in pairs])
    degree = max(spline.Degree for spline in splines)
    for spline in splines:
        spline.increaseDegree(degree)
    return _joined([nurbs_of_spline(s) for s in splines], degree), max(deviation for _, deviation in pairs)


def _head_to_tail(splines):
    """A wire gives the sense of its edges, but for one that is its only edge's neighbour at both ends."""
    if len(splines) > 1:
        first, second = splines[0], splines[1]
        ends = (second.StartPoint, second.EndPoint)
        if min(first.EndPoint.distanceToPoint(p) for p in ends) > min(first.StartPoint.distanceToPoint(p) for p in ends):
            first.reverse()
    for before, after in zip(splines, splines[1:]):
        if before.EndPoint.distanceToPoint(after.EndPoint) < before.EndPoint.distanceToPoint(after.StartPoint):
            after.reverse()
    return splines


def _joined(pieces, degree):
    knots, points, weights = [0.0] * (degree + 1), [], []
    for piece in pieces:
        start, end = piece["knots"][0], piece["knots"][-1]
        own = piece.get("weights") or [1.0] * len(piece["control_points"])
        scale = weights[-1] / own[0] if weights else 1.0
        skip = 1 if points else 0  # the end of the one before
        offset = knots[-1]
        points += piece["control_points"][skip:]
        weights += [scale * w for w in own][skip:]
        inner = piece["knots"][degree + 1 : -degree - 1]
        knots += [offset + (knot - start) for knot in inner] + [offset + (end - start)] * degree
    knots.append(knots[-1])
    joined = {"degree": degree, "knots": knots, "control_points": points}
    if max(weights) - min(weights) > 1e-14 * max(weights):
        joined["weights"] = weights
    return joined if len(pieces) > 1 else pieces[0]
