"""An analysis of a document as a case file."""

import contextlib
import json
import os
from typing import Any, NamedTuple

from .. import objects
from ..geometry.places import NoPlace
from . import parts
from .beams import beam_keys
from .places_of_case import Place
from .values import Fault, agree, merged, name_for_case, si, times_unit


class WrittenCase(NamedTuple):
    """A case, and what is known of it before nurbeam is asked."""

    keys: "dict[str, Any]"
    text: str
    """JSON"""
    places: "dict[str, Place]"
    """Objects and properties by paths in the case."""
    faults: "list[Fault]"
    """What makes it no case."""
    notes: "list[Fault]"
    files: "dict[str, list]"
    """Edges of profiles, by the names of their files beside the case."""
    names: "dict[Any, str]"
    """Of beams and bodies, by their objects."""

    def write_into(self, folder, name="case.json"):
        """Writes the case and its files; returns the path of the case."""
        import Part

        os.makedirs(folder, exist_ok=True)
        for file, edges in self.files.items():
            Part.makeCompound(edges).exportStep(os.path.join(folder, file))
        path = os.path.join(folder, name)
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(self.text)
        return path


class _Writer:
    def __init__(self):
        self.places, self.faults, self.notes, self.files = {}, [], [], {}
        self.beams, self.bodies = {}, {}

    def place(self, path, obj, prop):
        self.places[path] = Place(obj, prop)

    def note(self, obj, prop, message):
        self.notes.append(Fault(obj, prop, message))

    @contextlib.contextmanager
    def faults_of(self, obj, prop):
        try:
            yield
        except (ValueError, NoPlace, ReferenceError) as problem:
            self.faults.append(Fault(obj, prop, str(problem)))

    def beam_name(self, obj, prop):
        beam = getattr(obj, prop)
        if beam in self.beams:
            return self.beams[beam]
        what = "no beam is chosen" if beam is None else f"{beam.Label} is no beam of this analysis"
        known = ", ".join(self.beams.values())
        self.faults.append(Fault(obj, prop, f"{what}; choose one: {known}" if known else f"{what}; make one first"))
        return None

    def beam_names(self, obj, prop, least):
        chosen = getattr(obj, prop)
        names = [self.beams[beam] for beam in chosen if beam in self.beams]
        if len(names) < max(least, len(chosen)):
            self.faults.append(Fault(obj, prop, f"{len(names)} beams of this analysis are chosen; expected {max(least, len(chosen))}"))
        return names

    def body_names(self, obj, prop):
        names = [self.bodies[body] for body in getattr(obj, prop) if body in self.bodies]
        if len(names) < len(getattr(obj, prop)):
            self.faults.append(Fault(obj, prop, "not all that is chosen is a sliding body of this analysis"))
        return names

    def named(self, group):
        """Names of objects that are unlike each other."""
        names = {}
        for obj in group:
            names[obj] = name_for_case(obj.Label, set(names.values()), obj.Name)
            if names[obj] != name_for_case(obj.Label, set(), obj.Name):
                self.note(obj, "Label", f'another one has this name, too; results name this one "{names[obj]}"')
        return names

    def with_extra(self, obj, keys, path="", is_meant=lambda key: True):
        """The keys with the extra ones of the object; messages about those that are new belong to ExtraKeys."""
        with self.faults_of(obj, "ExtraKeys"):
            result = merged(keys, obj.ExtraKeys, is_meant)
            for key in result.keys() - keys.keys():
                self.place(f"{path}.{key}" if path else key, obj, "ExtraKeys")
            return result
        return keys


def written_case(analysis):
    """The case of an analysis, by its present objects."""
    writer = _Writer()
    found = {cls: objects.members(analysis, cls) for cls in objects.CLASSES}
    writer.beams, writer.bodies = writer.named(found[objects.Beam]), writer.named(found[objects.SlidingBody])
    case = {"nurbeam": 1, "name": name_for_case(analysis.Label, set(), analysis.Name)}
    _write_surroundings(analysis, case, writer)
    if not writer.beams:
        writer.faults.append(Fault(analysis, "Group", "there is no beam; choose an edge or a pipe and make one"))
    _write_lists(found, case, writer)
    case["analysis"] = analysis_keys(analysis, writer)
    case["output"] = output_keys(analysis, found[objects.Probe], writer)
    if not case["output"]:
        del case["output"]
    case = writer.with_extra(analysis, case)
    text = json.dumps(case, indent=1, ensure_ascii=False)
    names = {**writer.beams, **writer.bodies}
    return WrittenCase(case, text, writer.places, writer.faults, writer.notes, writer.files, names)


def _write_lists(found, case, writer):
    def write(key, group, keys_of, names=None, is_meant=lambda key: True):
        names = names if names is not None else writer.named(group)
        paths = [f"{key}[{i}]" for i in range(len(group))]
        items = [writer.with_extra(obj, keys_of(obj, names[obj], writer, path), path, is_meant) for obj, path in zip(group, paths)]
        if items:
            case[key] = items

    write("beams", found[objects.Beam], beam_keys, writer.beams)
    bodies = found[objects.SlidingBody]
    write("bodies", bodies, parts.body_keys, writer.bodies, parts.BODY_KEYS.__contains__)
    write("supports", found[objects.Support], parts.support_keys)
    write("sliding_joints", bodies, parts.sliding_joint_keys, writer.bodies, lambda key: key not in parts.BODY_KEYS)
    write("loads", found[objects.Load], lambda obj, _, w, path: parts.load_keys(obj, w, path))
    write("joints", found[objects.Joint], parts.joint_keys)
    write("connectors", found[objects.Connector], parts.connector_keys)
    write("stops", found[objects.Stop], lambda obj, _, w, path: parts.stop_keys(obj, w, path))


def _write_surroundings(analysis, case, writer):
    writer.place("gravity", analysis, "Gravity")
    with writer.faults_of(analysis, "GravityDirection"):
        gravity = times_unit(si(analysis.Gravity, "m/s^2"), analysis.GravityDirection)
        if gravity is None:
            raise ValueError("is 0 0 0, which is no direction; for no weight give a Gravity of 0")
        case["gravity"] = gravity
    if density := si(analysis.AirDensity, "kg/m^3"):
        case["air"] = {"density": density}
        if wind := si(analysis.Wind, "m/s"):
            case["air"]["wind"] = times_unit(wind, analysis.WindDirection)
        writer.place("air", analysis, "AirDensity")
        writer.place("air.wind", analysis, "Wind")


TYPES = {"Motion": "dynamic", "Equilibrium": "static", "Modes": "modes", "Buckling": "buckling"}


def analysis_keys(analysis, writer):
    keys = {"type": TYPES[analysis.AnalysisType]}
    writer.place("analysis", analysis, "AnalysisType")
    if keys["type"] == "dynamic":
        keys["initial"] = analysis.Start.lower().replace(" ", "-")
        keys["end_time"] = si(analysis.EndTime, "s")
        step = si(analysis.Step, "s")
        keys.update({"step": step} if step else {"tolerance": analysis.Tolerance})
    elif keys["type"] == "static":
        if analysis.LoadSteps:
            keys["load_steps"] = analysis.LoadSteps
    else:
        keys["modes"] = {"count": analysis.ModeCount}
    names = (("initial", "Start"), ("end_time", "EndTime"), ("step", "Step"), ("tolerance", "Tolerance"),
             ("load_steps", "LoadSteps"), ("modes", "ModeCount"))  # fmt: skip
    for key, prop in names:
        writer.place(f"analysis.{key}", analysis, prop)
    return keys


def output_keys(analysis, probes, writer):
    keys = {}
    writer.place("output", analysis, "Every")
    if analysis.AnalysisType == "Motion" and (every := si(analysis.Every, "s")):
        keys["every"] = every
    if probes:
        names = writer.named(probes)
        paths = [f"output.probes[{i}]" for i in range(len(probes))]
        keys["probes"] = [writer.with_extra(obj, parts.probe_keys(obj, names[obj], writer, path), path) for obj, path in zip(probes, paths)]
    return keys


def is_same_case(text, other):
    """Whether two texts are the same case, but for the last digits, which saving a document rounds."""
    if not other:
        return False
    return agree(json.loads(text), json.loads(other))
