"""What a run has left: histories, and the beams at its output times."""

from __future__ import annotations

import html
import json
import operator
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, overload

import numpy as np
import numpy.typing as npt

from . import _core
from .accuracy import Accuracy
from .checked import reduced
from .curves import Curve, write
from .errors import ByName, Error, MissingResults, findings_of, tell, unknown
from .pages import page_of

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.axes
    import pandas
    import xarray

__all__ = ["Results", "RunError", "Extreme", "Histories", "Snapshot", "BeamShape", "Motion", "Mode", "Modes"]

Array = npt.NDArray[np.float64]

# Vectors that stand in three columns: what stands behind the object's name.
_VECTORS = {
    "position": ("x", "y", "z"),
    "velocity": ("vx", "vy", "vz"),
    "displacement": ("ux", "uy", "uz"),
    "joint_force": ("joint_force.x", "joint_force.y", "joint_force.z"),
    "force": ("fx", "fy", "fz"),
    "couple": ("mx", "my", "mz"),
}


class Histories(Mapping[str, Array]):
    """Values over the output times, by the names of the columns of `histories.csv` without their units:
    `"trolley.x"`, `"energy.total"`, `"time"`. `"trolley.position"`, `.velocity`, `.displacement`, `.joint_force`, and of
    supports and joints `.force` and `.couple` are the vectors, (times, 3); `"trolley.speed"` is that of the velocity.

    Numbers that there are none of, as the position of a body that has left its beam, are NaN.
    """

    def __init__(self, times: Array, columns: Sequence[tuple[str, str, str]], values: Array):
        self._columns = {"time": times}
        self._columns.update({f"{name}.{quantity}": values[:, i] for i, (name, quantity, _) in enumerate(columns)})
        self.units: dict[str, str] = {"time": "s"}
        """Of each column: "m", "N m", ..."""
        self.units.update({f"{name}.{quantity}": unit for name, quantity, unit in columns})

    def __getitem__(self, name: str) -> Array:
        if name in self._columns:
            return self._columns[name]
        of, _, quantity = name.rpartition(".")
        parts = [f"{of}.{part}" for part in _VECTORS.get(quantity, ())]
        if parts and all(part in self._columns for part in parts):
            return np.stack([self._columns[part] for part in parts], axis=1)
        if quantity == "speed" and f"{of}.vx" in self._columns:
            return np.asarray(np.linalg.norm(self[f"{of}.velocity"], axis=1))
        raise KeyError(unknown("history", name, self._columns))

    def unit(self, name: str) -> str:
        """Of a column, or of a vector of them."""
        if name in self.units:
            return self.units[name]
        of, _, quantity = name.rpartition(".")
        first = {"speed": "vx"}.get(quantity) or _VECTORS.get(quantity, ("",))[0]
        self[name]
        return self.units[f"{of}.{first}"]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return f"<Histories at {len(self._columns['time'])} times: {', '.join(self._columns)}>"


class Motion(NamedTuple):
    """Of a body or a probe at a time."""

    position: Array
    """(3,) [m]"""
    velocity: Array
    """(3,) [m/s]"""


class ConnectorPull(NamedTuple):
    """Of a connector at a time: (2, 3) `ends`, from and to [m], NaN of results of earlier versions; their distance or its
    part along the connector's direction, `length` [m]; the `force` that pulls them together [N]."""

    ends: Array
    length: float
    force: float


class Extreme(NamedTuple):
    """The largest magnitude of a quantity in a run; of the minimum axial force the minimum."""

    value: float
    unit: str
    s: float
    """Reference arc length of the position on its beam [m]; NaN where there is none"""
    time: float
    """[s]; of a static analysis the load factor"""


class RunReport(Dict[str, Any]):
    """How a run ended, and what it took; of a directory what its run.json holds. Called with a file it puts the report page
    of the run there: `results.report("x.html")`."""

    def __init__(self, facts: Mapping[str, Any], page: Callable[[], str] | None = None):
        super().__init__(facts)
        self._page = page

    def __call__(self, file: str | os.PathLike[str]) -> None:
        if self._page is None:
            raise Error("this report is not that of results; ask results.report")
        if not os.fspath(file).lower().endswith((".html", ".htm")):
            raise ValueError(f"{os.fspath(file)}: the report is a page; expected a name that ends in .html")
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(self._page())

    def __reduce__(self) -> Any:
        return RunReport, (dict(self),)


class Mode(NamedTuple):
    """One mode of vibration, or of buckling."""

    frequency: float
    """[Hz]; NaN for buckling"""
    factor: float
    """On the loads that are not gravity, for buckling; NaN for vibrations. Below 0 for reversed loads."""
    effective_mass: Array
    """(3,) along x, y and z [kg]"""
    shape: Snapshot
    """Moved by an amplitude that makes it visible."""
    whirl: int = 0
    """1 forward, -1 backward, as rotors of bodies or the frame turn; else 0"""


class Modes(List[Mode]):
    """Modes, the lowest first, with their `errors`, (modes,): of mesh, of the frequency [Hz] or the factor, of a run that
    was asked for them; else NaN."""

    def __init__(self, modes: Sequence[Mode] = (), errors: Sequence[float] = ()):
        super().__init__(modes)
        self.errors: Array = np.array(errors, dtype=float)


class BeamShape:
    """A beam at a moment, in world coordinates. `name` is the beam's."""

    def __init__(self, frame: _core.Frame, index: int, name: str):
        self._frame = frame
        self._index = index
        self.name = name

    def __reduce__(self) -> Any:
        """Pickled with its snapshot."""
        return reduced(BeamShape, self._frame, self._index, self.name)

    @property
    def length(self) -> float:
        """Deformed [m]."""
        return self._frame.length(self._index)

    @property
    def curve(self) -> Curve:
        """The deformed axis as one exact NURBS curve with few control points."""
        return Curve._of(self._frame.curve(self._index, False, 1), self.name)

    @property
    def material_curve(self) -> Curve:
        """The same, whose parameter at the elements' ends is the reference arc length [m]."""
        return Curve._of(self._frame.curve(self._index, True, 1), self.name)

    @property
    def nodes(self) -> Array:
        """(nodes, 3) positions [m]."""
        return self._frame.nodes(self._index)[1]

    @property
    def node_slopes(self) -> Array:
        """(nodes, 3) dr/ds [-]; on the left of a slope discontinuity."""
        return self._frame.nodes(self._index)[2]

    @property
    def node_s(self) -> Array:
        """(nodes,) reference arc lengths [m]."""
        return self._frame.nodes(self._index)[0]

    @property
    def control_points(self) -> Array:
        """(elements, 4, 4): homogeneous control points (w x, w y, w z, w) of each element's rational cubic [m]."""
        return self._frame.control_points(self._index, 1)

    def exaggerated(self, factor: float, material: bool = False) -> Curve:
        """The axis with displacements from the drawing times `factor`: 1 gives `curve`, 0 the drawing; with `material` its
        parameter is that of `material_curve`."""
        return Curve._of(self._frame.curve(self._index, material, factor), self.name)

    @property
    def s(self) -> Array:
        """(4 elements,) reference arc lengths of the positions where `field` has its values [m]."""
        ends = self._frame.element_ends(self._index)
        return np.asarray(ends[:, :1] + (ends[:, 1:] - ends[:, :1]) * np.array([0, 1, 2, 3]) / 3).ravel()

    @property
    def fields(self) -> list[str]:
        """The names that `field` knows."""
        return list(self._frame.sampled(self._index))

    def field(self, name: str) -> Array:
        """What the sections carry along the beam, at `s`: "axial_force", "bending_moment", "shear_force", "torque",
        "stress", "strain", "curvature", ... (4 elements,) in SI units; "velocity" (4 elements, 3). At a node there are
        two values, one of each element. NaN where there is none."""
        sampled = self._frame.sampled(self._index)
        if name not in sampled:
            raise KeyError(unknown("field", name, sampled))
        values: Array = sampled[name]
        return values.reshape((-1,) + values.shape[2:])

    def points(self, per_element: int = 8, exaggerate: float = 1) -> Array:
        """(n, 3) points along the deformed beam [m], so many for each element, and its end; with displacements from the
        drawing times `exaggerate`, of which 0 gives the drawing."""
        u = np.linspace(0, 1, per_element, endpoint=False)
        basis = np.stack([(1 - u) ** 3, 3 * u * (1 - u) ** 2, 3 * u**2 * (1 - u), u**3])
        cubics = self._frame.control_points(self._index, exaggerate)
        rows = np.einsum("ku,ekh->euh", basis, cubics).reshape(-1, 4)
        rows = np.concatenate([rows, cubics[-1, -1:]])
        return np.asarray(rows[:, :3] / rows[:, 3:])

    def __repr__(self) -> str:
        return f'<BeamShape "{self.name}", length {self.length:.6g} m>'

    def _repr_svg_(self) -> str:
        from .drawing import svg

        return svg([self.points()])


class Snapshot:
    """A moment of a run, in world coordinates."""

    def __init__(self, frame: _core.Frame):
        self._frame = frame

    def __reduce__(self) -> Any:
        """Pickled without the other snapshots of its run."""
        return reduced(Snapshot, self._frame)

    @property
    def time(self) -> float:
        """[s]; of a static analysis the load factor, 0 where it has no `load_steps` and nothing changes with them; of modes the
        number of the mode."""
        return self._frame.time

    @property
    def beams(self) -> dict[str, BeamShape]:
        """By name."""
        names = self._frame.recording.beams
        return ByName("beam", {name: BeamShape(self._frame, i, name) for i, name in enumerate(names)})

    @property
    def bodies(self) -> dict[str, Motion]:
        """By name."""
        return ByName("body", {name: Motion(*motion) for name, motion in self._frame.bodies().items()})

    @property
    def connectors(self) -> dict[str, ConnectorPull]:
        """By name."""
        return ByName("connector", {name: ConnectorPull(*one) for name, one in self._frame.connectors().items()})

    @property
    def probes(self) -> dict[str, Motion]:
        """By name."""
        return ByName("probe", {name: Motion(*motion) for name, motion in self._frame.probes().items()})

    def __getitem__(self, name: str) -> float:
        """One value of the histories: `snapshot["energy.total"]`."""
        columns = self._frame.recording.columns()
        values = dict(zip((f"{of}.{quantity}" for of, quantity, _ in columns), self._frame.values()))
        if name not in values:
            raise KeyError(unknown("history", name, values))
        return values[name]

    def export(
        self, file: str | os.PathLike[str], unit: str = "mm", schema: str = "ap214", exaggerate: float = 1
    ) -> None:
        """Writes the deformed axes to a CAD file, as `nurbeam.write` does, with displacements from the drawing times
        `exaggerate`."""
        write(file, [beam.exaggerated(exaggerate) for beam in self.beams.values()], unit, schema)

    def __repr__(self) -> str:
        return f"<Snapshot at {self.time:.6g} s of {', '.join(self.beams)}>"

    def _repr_svg_(self) -> str:
        from .drawing import svg

        return svg([beam.points() for beam in self.beams.values()])


class Results(Sequence[Snapshot]):
    """The results of a run: a sequence of its snapshots, in memory.

    `Results("directory")` reads those that a run has left there, also while it goes on; `model.run(...)` returns its own.
    Error where there are none, also a FileNotFoundError where there is no such directory.
    """

    def __init__(self, directory: str | os.PathLike[str]):
        self.directory: Path | None = Path(directory)
        """Where they stand; None of a run that has written nothing."""
        summary = self.directory / "run.json"
        if not self.directory.is_dir():
            raise MissingResults(f"{self.directory}: does not exist")
        try:
            self._recording = _core.read_results(os.fspath(directory))
            report = json.loads(_core.checked_json(os.fspath(summary))) if summary.exists() else {}
        except (RuntimeError, ValueError) as problem:
            raise Error(str(problem)) from None
        tell(findings_of(_core.missing_checksum(os.fspath(directory))))
        self._summary = ""
        self.report = RunReport(report, self._page)
        """How the run ended, and what it took; of a directory what its run.json holds. `results.report("x.html")` puts its
        report page into a file."""
        self._histories: Histories | None = None
        facts = report.get("accuracy")
        self._accuracy = Accuracy._of_directory(facts, self.directory) if facts else None

    @classmethod
    def _of(cls, recording: _core.Recording, report: Mapping[str, Any], summary: str = "") -> Results:
        results = cls.__new__(cls)
        results.directory = None
        results._recording = recording
        results._summary = summary
        results.report = RunReport(report, results._page)
        results._histories = None
        results._accuracy = None
        return results

    @property
    def name(self) -> str:
        """Of the case."""
        return self._recording.title

    @property
    def times(self) -> Array:
        """The output times [s]; of a static analysis its load factors, 0 where it has no `load_steps` and nothing changes with
        them; numbers of modes."""
        return self._recording.times()

    @property
    def histories(self) -> Histories:
        """Values over the output times, or over the rows of `output.histories_every`; these are more, and between output
        times NaN where all elements would be needed."""
        recording = self._recording
        if self._histories is None or len(self._histories["time"]) != recording.history_count():
            self._histories = Histories(recording.history_times(), recording.columns(), recording.histories())
        return self._histories

    @property
    def steps(self) -> Array:
        """(steps, 4): each step's end [s], length [s], Newton iterations and attempts thrown away."""
        return self._recording.steps()

    @property
    def beams(self) -> list[str]:
        """Names."""
        return self._recording.beams

    @property
    def bodies(self) -> list[str]:
        """Names."""
        return self._recording.bodies

    @property
    def accuracy(self) -> Accuracy:
        """The errors of mesh and step, of a run that was asked for them: `model.run(..., accuracy=True)`. Error without."""
        if self._accuracy is None:
            raise Error("the run was not asked for its errors; run with accuracy=True, or accuracy=\"1 %\"")
        return self._accuracy

    @property
    def modes(self) -> Modes:
        """Of an analysis of modes or buckling in memory, the lowest first."""
        table = self._recording.modes()
        if table is None:
            raise Error('there are no modes; run with type="modes" or type="buckling", and without "out"')
        buckling, _, rows = table
        modes = [
            Mode(
                float("nan") if buckling else omega / (2 * np.pi),
                factor if buckling else float("nan"),
                participation**2,
                self[i],
                whirl,
            )
            for i, (omega, factor, participation, whirl) in enumerate(rows, 1)
        ]
        known = self._accuracy.table() if self._accuracy is not None else []
        errors = {number.quantity: number.error for number in known}
        return Modes(modes, [errors.get(f"mode {i}", float("nan")) for i in range(1, len(modes) + 1)])

    @property
    def extremes(self) -> dict[str, Extreme]:
        """What stands out in the run, over all its steps and inside elements: `results.extremes["cable.stress.max"].value`."""
        nan = float("nan")
        found = {
            one["quantity"]: Extreme(
                nan if one["value"] is None else one["value"], one["unit"],
                nan if one["s [m]"] is None else one["s [m]"], one["time [s]"]
            )
            for one in self.report.get("extremes", [])
        }  # fmt: skip
        return ByName("extreme", found)

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happened between the steps, in order: mesh adaptations, bodies that leave, stop or are released, each
        with its `time` [s], `kind`, `beam`, `body` and position `s` [m] on the beam; of a directory more (`report`)."""
        nobody = {"beam": None, "body": None}
        return [
            {**nobody, **{key.partition(" [")[0]: value for key, value in event.items()}}
            for event in self.report.get("events", [])
        ]

    def __reduce__(self) -> Any:
        """Results of a directory are pickled as their path, those in memory with their contents."""
        if self.directory is None:
            return reduced(_in_memory, self._recording, dict(self.report), self._summary, self._accuracy)
        return reduced(Results, os.fspath(self.directory.absolute()))

    def __copy__(self) -> Results:
        copied = Results.__new__(Results)
        copied.__dict__.update(self.__dict__)
        return copied

    def __len__(self) -> int:
        return len(self._recording)

    @overload
    def __getitem__(self, key: int) -> Snapshot: ...
    @overload
    def __getitem__(self, key: slice) -> list[Snapshot]: ...
    @overload
    def __getitem__(self, key: str) -> Array: ...
    def __getitem__(self, key: int | slice | str) -> Snapshot | list[Snapshot] | Array:
        if isinstance(key, str):
            return self.histories[key]
        if isinstance(key, slice):
            return [self[i] for i in range(*key.indices(len(self)))]
        try:
            number = operator.index(key)
        except TypeError:
            raise TypeError(f"the number of a snapshot is {key!r}; expected a whole number, a slice or the name of a history") from None
        i = number + len(self) if number < 0 else number
        if not 0 <= i < len(self):
            raise IndexError(f"there is no snapshot {key}; there are {len(self)}, counted from 0")
        return Snapshot(self._recording.frame(i))

    def at(self, time: float) -> Snapshot:
        """The snapshot nearest to a time [s]. ValueError outside the times of the run."""
        times = self.times
        if not isinstance(time, (int, float, np.number)):
            raise TypeError(f"the time is {time!r}; expected a number in seconds")
        if len(times) == 0 or not times[0] * (1 - 1e-9) <= time <= times[-1] * (1 + 1e-9):
            span = f"from {times[0]:.6g} to {times[-1]:.6g} s" if len(times) else "none"
            raise ValueError(f"time {time} s is not among those of the run, {span}")
        return self[int(np.argmin(np.abs(times - time)))]

    def _page(self) -> str:
        """The report page, as HTML that needs nothing else."""
        if self.directory is not None:
            page = self.directory / "report.html"
            if not page.exists():
                raise Error(f'there is no {page}; run again without "report": false in the "output" of the case')
            return page.read_text(encoding="utf-8")
        if not len(self):
            raise Error("there is no snapshot to report")
        return page_of(self._recording, self.report, self._summary)

    def _repr_html_(self) -> str:
        """In a notebook: the report page, which loads nothing from the network."""
        return f'<iframe srcdoc="{html.escape(self._page())}" style="width: 100%; height: 640px; border: 0"></iframe>'

    def animate(
        self, file: str | os.PathLike[str] | None = None, fps: float = 20, exaggerate: float = 1
    ) -> matplotlib.animation.FuncAnimation:
        """The motion as an animation by matplotlib, seen along the axis in which the beams have their smallest size; `exaggerate` as in
        `plot_shape`. With `file`, a .gif, .mp4 or .html, it is written there; the .html needs no network. In a notebook
        `IPython.display.HTML(results.animate().to_jshtml())` shows it; `results.report("x.html")` has the 3-D view."""
        from . import plots

        moments = [
            plots.Picture(
                snapshot.time,
                [beam.points(exaggerate=exaggerate) for beam in snapshot.beams.values()],
                [motion.position for motion in snapshot.bodies.values()] if exaggerate == 1 else [],
            )
            for snapshot in self
        ]
        if not moments:
            raise Error("there is no snapshot to show")
        animation = plots.animation(moments, fps)
        if file is not None:
            plots.save_animation(animation, os.fspath(file), fps)
        return animation

    def to_dataframe(self) -> pandas.DataFrame:
        """The histories as a pandas DataFrame over time; `.attrs["units"]` holds the units."""
        import pandas

        frame = pandas.DataFrame({k: v for k, v in self.histories.items() if k != "time"}, index=self.histories["time"])
        frame.index.name = "time"
        frame.attrs["units"] = dict(self.histories.units)
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """The histories as an xarray Dataset over time, each with its unit."""
        import xarray

        variables = {k: ("time", v, {"units": self.histories.units[k]}) for k, v in self.histories.items() if k != "time"}
        times = ("time", self.times, {"units": "s"})
        return xarray.Dataset(variables, coords={"time": times}, attrs={"title": self.name})

    def plot(self, *names: str, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Histories over time, by their names: `results.plot("trolley.speed")`; of a vector its components. A band shows the
        errors of a run that was asked for them."""
        from . import plots

        of = self.histories
        shown = names or [name for name in of if name.startswith("energy.")]
        return plots.histories(of["time"], {name: (of[name], of.unit(name)) for name in shown}, ax, self._accuracy)

    def plot_shape(
        self,
        times: Sequence[float] | None = None,
        ax: matplotlib.axes.Axes | None = None,
        exaggerate: float = 1,
    ) -> matplotlib.axes.Axes:
        """The beams and bodies at some times [s], six when omitted, seen along the axis of their smallest size. With
        `exaggerate` other than 1 the displacements of the beams are so many times those of the run, the drawing is shown
        in grey, and bodies are left out."""
        from . import plots

        if times is None:
            chosen = [self[int(i)] for i in np.unique(np.linspace(0, len(self) - 1, 6).round())]
        else:
            chosen = [self.at(time) for time in times]
        pictures = [
            plots.Picture(
                snapshot.time,
                [beam.points(exaggerate=exaggerate) for beam in snapshot.beams.values()],
                [motion.position for motion in snapshot.bodies.values()] if exaggerate == 1 else [],
            )
            for snapshot in chosen
        ]
        drawn = [] if exaggerate == 1 else [beam.points(exaggerate=0) for beam in chosen[0].beams.values()]
        return plots.shapes(pictures, ax, drawn)

    def plot_along(
        self,
        field: str,
        beam: str | None = None,
        time: float | None = None,
        ax: matplotlib.axes.Axes | None = None,
    ) -> matplotlib.axes.Axes:
        """What the sections of a beam carry along it at a time [s]: `results.plot_along("bending_moment")`; of the first
        beam and at the last time when omitted. The names are those of `BeamShape.field`."""
        from . import plots

        snapshot = self[-1] if time is None else self.at(time)
        name = self.beams[0] if beam is None else beam
        if name not in snapshot.beams:
            raise KeyError(unknown("beam", name, snapshot.beams))
        shape = snapshot.beams[name]
        return plots.along(shape.s, shape.field(field), f"{field} of {name}", field, snapshot.time, ax)

    def export(
        self,
        file: str | os.PathLike[str],
        time: float | None = None,
        unit: str = "mm",
        schema: str = "ap214",
        exaggerate: float = 1,
    ) -> None:
        """Writes the deformed axes at a time [s], the last when omitted, to a CAD file, as `nurbeam.write` does, with
        displacements from the drawing times `exaggerate`."""
        (self[-1] if time is None else self.at(time)).export(file, unit, schema, exaggerate)

    def __repr__(self) -> str:
        times = self.times
        span = "1 snapshot" if len(times) == 1 else f"{len(times)} snapshots"
        span += f", {times[0]:.6g} to {times[-1]:.6g} s" if len(times) else ""
        return f'<Results of "{self.name}": {span}>'


def _in_memory(recording: _core.Recording, report: Mapping[str, Any], summary: str, accuracy: Accuracy | None) -> Results:
    results = Results._of(recording, report, summary)
    results._accuracy = accuracy
    return results


class RunError(Error, RuntimeError):
    """A run that has ended before its end. `results` are the results until then, None where there are none."""

    def __init__(self, message: str, results: Results | None = None):
        self.results = results
        super().__init__(message)

    def __reduce__(self) -> Any:
        """Pickled with the results."""
        return reduced(type(self), str(self), self.results)
