"""A result in the 3-D view: frames, exaggeration, colours, tubes, and bodies that move along, all by nodes of coin."""

import numpy as np
from pivy import coin

from ..case.write_case import written_case
from ..geometry import places
from ..run.results import radii_of_beam, read

PLACES = 201  # of a beam that are drawn
CORNERS = 12  # of the section of a tube
TUBE = 0.005  # radius of a tube over the size of the model, of a beam whose radius is not known
LOW, HIGH = 1, 99  # percentiles that the colours span
FAINT = 0.8  # transparency of what the beams were drawn on
UNITS = {"axial_force": "N", "shear_force": "N", "bending_moment": "N m", "moment_1": "N m", "moment_2": "N m", "torque": "N m",
         "stress": "Pa", "von_mises": "Pa", "curvature": "1/m", "displacement": "m", "twist": "rad", "velocity": "m/s"}  # fmt: skip

# Blue to red over light grey, as (n, 3).
COLOURS = np.array([[0.23, 0.30, 0.75], [0.55, 0.69, 1.00], [0.87, 0.87, 0.87], [0.96, 0.61, 0.48], [0.71, 0.02, 0.15]])


def colours_of(values, low, high):
    """(n, 3) colours of (n,) values, on the scale from low to high."""
    span = high - low
    places = np.clip((values - low) / span, 0, 1) * (len(COLOURS) - 1) if span > 0 else np.zeros(len(values))
    places = np.nan_to_num(places)
    return np.stack([np.interp(places, np.arange(len(COLOURS)), COLOURS[:, i]) for i in range(3)], axis=1)


class Scale:
    """The colours of a quantity over a whole run."""

    def __init__(self, values):
        finite = values[np.isfinite(values)]
        self.low, self.high = (np.percentile(finite, LOW), np.percentile(finite, HIGH)) if len(finite) else (0.0, 0.0)
        self.least, self.greatest = (finite.min(), finite.max()) if len(finite) else (0.0, 0.0)


class BeamNode:
    """A beam as a line or a tube."""

    def __init__(self, name, radius):
        self.name, self.radius = name, radius
        self.node = coin.SoSeparator()
        light, self.style = coin.SoLightModel(), coin.SoDrawStyle()
        light.model = coin.SoLightModel.BASE_COLOR
        self.style.lineWidth = 4
        self.material, binding = coin.SoMaterial(), coin.SoMaterialBinding()
        binding.value = coin.SoMaterialBinding.PER_VERTEX
        self.points = coin.SoCoordinate3()
        self.lines, self.mesh = coin.SoLineSet(), coin.SoQuadMesh()
        self.lines.numVertices = PLACES
        self.mesh.verticesPerRow, self.mesh.verticesPerColumn = CORNERS + 1, PLACES
        self.choice = coin.SoSwitch()
        self.choice.addChild(self.lines)
        self.choice.addChild(self.mesh)
        for child in (light, self.style, self.material, binding, self.points, self.choice):
            self.node.addChild(child)

    def show(self, points, colours, as_tube):
        """`points`: (PLACES, 3) [mm]; `colours`: (PLACES, 3)."""
        if as_tube:
            points, colours = tube(points, self.radius), np.repeat(colours, CORNERS + 1, axis=0)
        self.choice.whichChild = 1 if as_tube else 0
        self.points.point.setNum(len(points))
        self.points.point.setValues(0, len(points), np.ascontiguousarray(points, dtype=np.float32))
        self.material.diffuseColor.setNum(len(colours))
        self.material.diffuseColor.setValues(0, len(colours), np.ascontiguousarray(colours, dtype=np.float32))


def tube(points, radius):
    """(PLACES (CORNERS + 1), 3): circles of that radius about a line of points, each turned as little as can be."""
    tangents = np.gradient(points, axis=0)
    tangents /= np.maximum(np.linalg.norm(tangents, axis=1), 1e-300)[:, None]
    normal = np.eye(3)[np.argmin(np.abs(tangents[0]))]
    angles = np.linspace(0, 2 * np.pi, CORNERS + 1)
    rings = []
    for point, tangent in zip(points, tangents):
        normal = normal - normal.dot(tangent) * tangent
        normal /= max(np.linalg.norm(normal), 1e-300)
        other = np.cross(tangent, normal)
        rings.append(point + radius * (np.outer(np.cos(angles), normal) + np.outer(np.sin(angles), other)))
    return np.concatenate(rings)


def _at_places(curve):
    return 1000 * curve(np.linspace(curve.start, curve.end, PLACES))


class Animation:
    """All that is shown of a result."""

    def __init__(self, result):
        self.results = read(result)
        self.times = np.asarray(self.results.times)
        self.names = list(self.results.beams)
        self.objects = self._objects_by_name(result)
        self.node = coin.SoSeparator()
        self._points = {name: self._all_points(name) for name in self.names}
        size = max(np.ptp(points.reshape(-1, 3), axis=0).max() for points in self._points.values())
        self._beams = [BeamNode(name, radii_of_beam(result, name)[0] or TUBE * size) for name in self.names]
        for beam in self._beams:
            self.node.addChild(beam.node)
        self._values, self.scale, self.frame = {}, None, 0
        self._bodies = self._body_nodes(size)
        self._moved = {}
        self._faded = self._fade()

    def _objects_by_name(self, result):
        return {name: obj for obj, name in written_case(result.Analysis).names.items()} if result.Analysis else {}

    def _fade(self):
        """Makes the pictures of the shapes that beams were drawn on faint: (root, node) of each."""
        roots = {root for obj in self.objects.values() for root, _ in places.parts_of_link(getattr(obj, "Axis", None))}
        faded = []
        for root in roots:
            faint = coin.SoMaterial()
            for field in (faint.ambientColor, faint.diffuseColor, faint.specularColor, faint.emissiveColor, faint.shininess):
                field.setIgnored(True)
            faint.transparency = FAINT
            faint.setOverride(True)
            root.ViewObject.RootNode.insertChild(faint, 0)
            faded.append((root.ViewObject.RootNode, faint))
        return faded

    def _all_points(self, name):
        """(frames + 1, PLACES, 3) [mm] at equal material coordinates; the first is the drawing."""
        drawn = self.results[0].beams[name].exaggerated(0, material=True)
        return np.array([_at_places(drawn), *(_at_places(frame.beams[name].material_curve) for frame in self.results)])

    def _body_nodes(self, size):
        nodes = {}
        for name in self.results.bodies:
            group, place, ball, colour = coin.SoSeparator(), coin.SoTranslation(), coin.SoSphere(), coin.SoMaterial()
            ball.radius, colour.diffuseColor = 0.01 * size, (0.85, 0.55, 0.1)
            for child in (colour, place, ball):
                group.addChild(child)
            if self._solid_of(name) is None:
                self.node.addChild(group)
            nodes[name] = place
        return nodes

    def _solid_of(self, name):
        body = self.objects.get(name)
        return getattr(body, "MovesWith", None) if body is not None else None

    @property
    def fields(self):
        """Names of quantities that colours may show."""
        return list(self.results[0].beams[self.names[0]].fields)

    def colour_by(self, field):
        """Takes the colours from a quantity; its scale holds for the whole run."""
        self._values = {name: np.array([self._field(frame.beams[name], field) for frame in self.results]) for name in self.names}
        self.scale = Scale(np.concatenate([values.ravel() for values in self._values.values()]))
        return self.scale

    @staticmethod
    def _field(shape, field):
        """(PLACES,) at equal material coordinates."""
        s, values = shape.s, shape.field(field)
        if values.ndim > 1:
            values = np.linalg.norm(values, axis=1)
        return np.interp(np.linspace(s[0], s[-1], PLACES), s, values)

    def show(self, frame, exaggeration=1.0, as_tube=False):
        """Shows a frame, counted from 0."""
        self.frame = frame
        for beam in self._beams:
            points = self._points[beam.name]
            shown = points[0] + exaggeration * (points[frame + 1] - points[0])
            values = self._values[beam.name][frame] if self._values else np.zeros(PLACES)
            colours = colours_of(values, self.scale.low, self.scale.high) if self.scale else np.full((PLACES, 3), 0.3)
            beam.show(shown, colours, as_tube)
        self._show_bodies(frame)

    def _show_bodies(self, frame):
        bodies = self.results[frame].bodies
        for name, place in self._bodies.items():
            position = 1000 * np.asarray(bodies[name].position)
            place.translation = tuple(float(x) for x in position)
            solid = self._solid_of(name)
            if solid is not None:
                start = 1000 * np.asarray(self.results[0].bodies[name].position)
                self._move(solid, position - start)

    def _move(self, solid, by):
        """Moves the picture of a solid, never its Placement."""
        view = solid.ViewObject.RootNode
        if solid.Name not in self._moved:
            shift = coin.SoTranslation()
            view.insertChild(shift, 0)
            self._moved[solid.Name] = (view, shift)
        self._moved[solid.Name][1].translation = tuple(float(x) for x in by)

    def release(self):
        """Puts solids back where they stand, as they were."""
        for view, node in [*self._moved.values(), *self._faded]:
            view.removeChild(node)
        self._moved, self._faded = {}, []
