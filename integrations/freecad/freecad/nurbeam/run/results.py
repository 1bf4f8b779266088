"""Results of runs in the document: kept whole, read by nurbeam."""

import functools
import json
import os
import shutil
import tempfile

import Part

from .. import objects
from ..geometry.edges import edge_of_nurbs
from .command import module, run_program


class NoResults(RuntimeError):
    """A result without data, or of a run that has ended before its first state."""


def take_results(analysis, case_text, folder, findings):
    """Keeps what a run has left in a folder in the result of the analysis, which is made where there is none; None, and all as it
    was, where the run has ended before its first state."""
    data = os.path.join(folder, "results.nc")
    if not os.path.exists(data) or len(_read(data, *_version(data))) == 0:
        return None
    result = objects.result_of(analysis) or objects.make(objects.Result, analysis.Document, analysis=analysis)
    if not result.Data and result.Label.startswith("Result"):
        result.Label = f"Result of {analysis.Label}"
    result.Analysis = analysis
    result.Data = data
    result.CaseText = case_text
    result.Warnings = [f"{f.severity}: {f.message}" for f in findings if f.severity != "error"]
    summary = _summary(folder)
    modes = summary.get("modes") or summary.get("buckling") or []
    result.Events = [*map(_mode_text, modes), *map(_event_text, summary.get("events", []))]
    results = read(result)
    result.Times = [float(t) for t in results.times]
    result.Frame = min(result.Frame, len(results) - 1)
    for shape in result.InList:
        shape.touch()
    return result


def _summary(folder):
    try:
        with open(os.path.join(folder, "run.json"), encoding="utf-8") as stream:
            return json.load(stream)
    except (OSError, ValueError):
        return {}


def _mode_text(mode):
    """As "mode 1: 14.4716 Hz" or "mode 1: buckles at 12.3 times the loads"."""
    of = f"{mode['frequency [Hz]']:.6g} Hz" if "frequency [Hz]" in mode else f"buckles at {mode['factor']:.6g} times the loads"
    return f"mode {mode['number']}: {of}"


def _event_text(event):
    """As "t = 0.498 s: merge, cable, trolley, s = 2.04435 m"."""
    what = [str(event[key]) for key in ("kind", "beam", "body") if event.get(key)]
    at = [f"s = {event['s [m]']:.6g} m"] if event.get("s [m]") is not None else []
    return f"t = {event.get('time [s]', 0):.6g} s: {', '.join(what + at)}"


def read(result):
    """`nurbeam.Results` of the data of a result, read once. NoResults where there is none."""
    if not result.Data or not os.path.exists(result.Data):
        raise NoResults(f"{result.Label} has no data; run the analysis")
    return _read(result.Data, *_version(result.Data))


def _version(file):
    stat = os.stat(file)
    return stat.st_mtime_ns, stat.st_size


@functools.lru_cache(maxsize=4)
def _read(data, _time, _size):
    nurbeam = module()
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(data, os.path.join(folder, "results.nc"))
        import warnings

        with warnings.catch_warnings():  # a document keeps no checksum beside the data
            warnings.simplefilter("ignore")
            return nurbeam.Results(folder)


def name_of(obj, result):
    """The name that an object has in the case of a result; its label where it cannot be told."""
    from ..case.write_case import written_case

    analysis = result.Analysis
    return written_case(analysis).names.get(obj, obj.Label) if analysis else obj.Label


def radii_of_beam(result, name):
    """Outer and inner radius [mm] of a round beam of the case that was run; 0 where its section is another."""
    beams = json.loads(result.CaseText or "{}").get("beams", [])
    section = next((beam.get("section", {}) for beam in beams if beam.get("name") == name), {})
    numbers = section.get("radius", section.get("rope", {}).get("diameter", 0) / 2), section.get("bore", 0)
    return [1000 * number for number in numbers]


def nurbs_at(result, beam, time, exaggeration=1.0):
    """The curve of a beam at the stored time nearest to `time`, in metres."""
    results = read(result)
    shapes = results[_nearest(results.times, time)].beams
    name = beam or next(iter(shapes))
    curve = shapes[name].curve if exaggeration == 1 else shapes[name].exaggerated(exaggeration)
    return {key: value for key, value in curve.to_dict().items() if key != "name"}


def _nearest(times, time):
    return min(range(len(times)), key=lambda i: abs(times[i] - time))


def deformed_shape(obj):
    """The shape of a DeformedShape, by its result alone."""
    if obj.Result is None:
        raise NoResults("no result is chosen")
    time = obj.Time.getValueAs("s").Value
    if obj.Form == "Curve":
        return edge_of_nurbs(nurbs_at(obj.Result, obj.BeamName, time, obj.Exaggeration))
    if obj.Radius.Value <= 0:
        raise NoResults("the Radius is 0; a solid needs one")
    return _solid(obj.Result, obj.BeamName, time, obj)


def _solid(result, beam, time, sizes):
    results = read(result)
    names = list(results.beams)
    if beam and beam not in names:
        raise NoResults(f"there is no beam {beam} in {result.Label}; it has {', '.join(names)}")
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(result.Data, os.path.join(folder, "results.nc"))
        file = os.path.join(folder, "solids.brep")
        arguments = ["export", folder, "--time", repr(time), "--to", file, "--exaggerate", repr(sizes.Exaggeration)]
        arguments += ["--solid", repr(sizes.Radius.Value / 1000)]
        arguments += ["--bore", repr(sizes.Bore.Value / 1000)] if sizes.Bore.Value else []
        run_program(arguments, NoResults, 60)
        return Part.read(file).Solids[names.index(beam) if beam else 0]
