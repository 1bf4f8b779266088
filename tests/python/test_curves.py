import pickle
import subprocess
import sys

import numpy as np
import pytest

import nurbeam as nb


def test_an_arc_is_a_circle_to_round_off():
    arc = nb.Curve.arc([1, 2, 0], [3, 2, 0], [1, 4, 0], [0, 0, 1])
    radii = np.linalg.norm(arc.sample(101) - [1, 2, 0], axis=1)
    assert np.abs(radii - 2).max() < 1e-14
    assert arc.length == pytest.approx(np.pi, rel=1e-13)
    assert arc.is_rational and arc.degree == 3


def test_points_are_those_of_the_bernstein_form():
    points = np.array([[0, 0, 0], [1, 2, 0], [3, 2, 1], [4, 0, 1.0]])
    weights = np.array([1, 0.5, 2, 1.0])
    curve = nb.Curve(points, weights=weights)
    u = np.linspace(0, 1, 7)
    basis = np.stack([(1 - u) ** 3, 3 * u * (1 - u) ** 2, 3 * u**2 * (1 - u), u**3], axis=1) * weights
    expected = basis @ points / basis.sum(axis=1, keepdims=True)
    assert np.abs(curve(u) - expected).max() < 1e-14
    assert curve(0.5).shape == (3,)
    assert np.array_equal(curve.control_points, points)
    assert np.array_equal(curve.knots, [0, 0, 0, 0, 1, 1, 1, 1])


def test_derivatives_are_the_limit_of_differences():
    curve = nb.Curve([[0, 0, 0], [1, 2, 0], [3, 2, 1], [4, 0, 1.0]], weights=[1, 0.5, 2, 1])
    exact = curve.derivatives(0.3, 2)
    errors = []
    for h in (1e-2, 5e-3):
        first = (curve(0.3 + h) - curve(0.3 - h)) / (2 * h)
        errors.append(np.linalg.norm(first - exact[1]))
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.01)


def test_derivatives_at_many_parameters_are_those_at_each():
    curve = nb.Curve.arc([0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1])
    u = np.array([[0.1, 0.2, 0.3], [0.5, 0.6, 1.0]])
    found = curve.derivatives(u, 2)
    assert found.shape == (2, 3, 3, 3)
    assert np.array_equal(found[1, 0], curve.derivatives(0.5, 2)) and np.array_equal(found[..., 0, :], curve(u))


def test_coordinates_whose_squares_are_no_numbers_are_refused_at_once():
    assert nb.Curve([[0, 0, 0], [1e90, 0, 0]]).length == pytest.approx(1e90, rel=1e-12)
    for far in (1e101, 1e200, 1e300):
        with pytest.raises(ValueError, match="must be at most 1e\\+100"):
            nb.Curve([[0, 0, 0], [far, 0, 0]]).length


def test_only_curves_are_written(tmp_path):
    with pytest.raises(TypeError, match="curve 2 is 'rail'; expected a Curve"):
        nb.write(tmp_path / "rail.step", [nb.Curve.line([0, 0, 0], [1, 0, 0]), "rail"])
    assert not list(tmp_path.iterdir())


NAMES = ["x') y", "b (m')", "5') b", "a'", "''", "',(", "#1=CARTESIAN_POINT('',(0.,0.,0.));", "/* no comment", "=1+1", "-x", "Br\u00fcckenseil",
         "a;b", "\\X2\\", "<b>&amp;", "x" * 250]


@pytest.mark.parametrize("extension", ["step", "iges", "json"])
def test_names_come_back_from_files(extension, tmp_path):
    lines = [nb.Curve.line([0, 0, i], [1, 0, i], name=name) for i, name in enumerate(NAMES)]
    nb.write(tmp_path / f"all.{extension}", lines)
    assert sorted(nb.read(tmp_path / f"all.{extension}").names) == sorted(NAMES)
    for line in lines:
        nb.write(tmp_path / f"one.{extension}", line)
        assert nb.read(tmp_path / f"one.{extension}").names == [line.name]


@pytest.mark.parametrize("name, rule", [("a\nb", "must not hold"), ("\0", "must not hold"), ("x" * (1 << 20), "at most 250")])
def test_names_that_no_file_holds_are_refused(name, rule, tmp_path):
    with pytest.raises(ValueError, match=f"the name of curve 1 .*{rule}") as refused:
        nb.write(tmp_path / "a.dxf", nb.Curve.line([0, 0, 0], [1, 0, 0], name=name))
    assert len(str(refused.value)) < 200 and not list(tmp_path.iterdir())


def test_curves_are_pickled_to_the_bit():
    curve = nb.Curve(np.random.default_rng(2).normal(size=(6, 3)), weights=[1, 0.3, 1.7, 1, 3, 1], name="rail")
    curve.facts["layer"] = "cables"
    again = pickle.loads(pickle.dumps(curve))
    assert (again.name, again.facts) == (curve.name, curve.facts)
    assert np.array_equal(again.control_points, curve.control_points) and np.array_equal(again.knots, curve.knots)
    assert np.array_equal(again.sample(20), curve.sample(20))


def test_inserted_knots_leave_the_curve_as_it_is():
    curve = nb.Curve(np.random.default_rng(1).normal(size=(7, 3)), weights=[1, 2, 0.5, 1, 1, 3, 1])
    finer = curve.insert_knot(0.4, 2).insert_knot(0.1)
    assert len(finer.weights) == 10
    assert np.abs(finer.sample(50) - curve.sample(50)).max() < 1e-13
    with pytest.raises(ValueError, match="cannot be inserted 4 times"):
        curve.insert_knot(0.4, 4)
    with pytest.raises(ValueError, match="inserted 0 times; must be at least 1"):
        curve.insert_knot(0.4, 0)
    with pytest.raises(ValueError, match="must lie between 0 and 1"):
        curve.insert_knot(1)


def test_bezier_pieces_are_the_curve():
    curve = nb.Curve(np.random.default_rng(2).normal(size=(6, 3)), degree=2)
    pieces = curve.to_bezier()
    breaks = np.unique(curve.knots)
    assert len(pieces) == len(breaks) - 1
    for piece, a, b in zip(pieces, breaks, breaks[1:]):
        u = np.linspace(0, 1, 9)
        assert np.abs(piece(u) - curve(a + u * (b - a))).max() < 1e-14


def test_cubics_of_a_higher_degree_keep_their_bound():
    curve = nb.Curve(np.random.default_rng(3).normal(size=(6, 3)), degree=5)
    cubic, deviation = curve.to_cubic(1e-5)
    assert cubic.degree == 3 and 0 < deviation <= 1e-5
    assert np.linalg.norm(cubic.sample(200) - curve.sample(200), axis=1).max() <= deviation, "at equal parameters"
    distance = [cubic.closest_point(p).distance for p in curve.sample(40)]
    assert max(distance) <= deviation * (1 + 1e-6) + 1e-12


@pytest.mark.parametrize("degree", [1, 3, 5])
def test_the_closest_point_is_where_no_other_is_nearer(degree):
    curve = nb.Curve(np.random.default_rng(degree).normal(size=(8, 3)), degree=degree)
    point = np.array([0.3, -0.2, 0.5])
    found = curve.closest_point(point)
    assert np.allclose(curve(found.parameter), found.point, atol=1e-14)
    samples = np.linalg.norm(curve.sample(20001) - point, axis=1)
    assert found.distance <= samples.min() + 1e-12
    assert found.distance >= samples.min() - 1e-3


@pytest.mark.parametrize("ask", [
    lambda curve: nb.Curve(curve.control_points, degree=2.9),
    lambda curve: curve.derivatives(0.3, 1.5),
    lambda curve: curve.insert_knot(0.3, "2"),
])
def test_numbers_that_are_counted_are_whole(ask):
    with pytest.raises(TypeError, match="(degree|n|times) is .*; expected a whole number"):
        ask(nb.Curve([[0, 0, 0], [1, 2, 0], [3, 2, 1], [4, 0, 1.0]], degree=np.int64(3)))


def test_what_is_no_curve_says_why():
    with pytest.raises(ValueError, match=r"shape \(3,\); expected \(n, 3\)"):
        nb.Curve([1, 2, 3])
    with pytest.raises(ValueError, match="1 control point"):
        nb.Curve([[1, 2, 3]])
    with pytest.raises(ValueError, match="weight"):
        nb.Curve([[0, 0, 0], [1, 0, 0]], weights=[1, -1])
    with pytest.raises(ValueError, match="weights of a NURBS curve must be finite"):
        nb.Curve([[0, 0, 0], [1, 0, 0]], weights=[1, np.nan])
    with pytest.raises(ValueError, match="must both be|both must be its radius"):
        nb.Curve.arc([0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 1])
    with pytest.raises(ValueError, match="not perpendicular"):
        nb.Curve.arc([0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 1])
    with pytest.raises(ValueError, match="1e-09 m apart.*same point twice for a whole circle"):
        nb.Curve.arc([0, 0, 0], [1, 0, 0], [1, 1e-9, 0], [0, 0, 1])
    assert nb.Curve.arc([0, 0, 0], [1, 0, 0], [1, 0, 0], [0, 0, 1]).length == pytest.approx(2 * np.pi, abs=1e-12)
    with pytest.raises(ValueError, match="not on the curve; must be between 0 and 1"):
        nb.Curve.line([0, 0, 0], [1, 0, 0])(1.5)


@pytest.mark.parametrize("extension", ["step", "igs", "dxf", "brep"])
def test_curves_come_back_from_files_as_they_went(tmp_path, extension):
    arc = nb.Curve.arc([0, 0, 0], [0.5, 0, 0], [0, 0.5, 0], [0, 0, 1], name="arc")
    bent = nb.Curve([[0, 0, 0], [1, 2, 0], [3, 2, 1], [4, 0, 1.0]], weights=[1, 0.5, 2, 1], name="bent")
    nb.write(tmp_path / f"curves.{extension}", [arc, bent])
    back = nb.read(tmp_path / f"curves.{extension}")
    assert len(back) == 2
    for old, new in zip([arc, bent], back):
        assert new.length == pytest.approx(old.length, rel=1e-11)
        assert np.abs(new.sample(20) - old.sample(20)).max() < 1e-11
    if extension in ("step", "igs"):
        assert back.names == ["arc", "bent"] and back["bent"].name == "bent"


def test_files_that_cannot_be_read_or_written_say_why(tmp_path, root):
    with pytest.raises(nb.CadError, match="absent.step"):
        nb.read(tmp_path / "absent.step")
    with pytest.raises(ValueError, match=r"\.step"):
        nb.write(tmp_path / "curve.txt", nb.Curve.line([0, 0, 0], [1, 0, 0]))
    with pytest.raises(nb.CadError):
        nb.write(tmp_path / "no" / "such" / "curve.step", nb.Curve.line([0, 0, 0], [1, 0, 0]))
    with pytest.raises(KeyError, match='did you mean \\\\?"Zip cable'):
        nb.read(root / "samples/zipline/cable.step")["Zip cabel"]


def test_curves_draw_themselves():
    picture = nb.Curve.arc([0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1])._repr_svg_()
    assert picture.startswith("<svg") and "polyline" in picture and "nan" not in picture
    assert "nan" not in nb.Curve.line([0, 0, 0], [1, 0, 0])._repr_svg_()


def test_importing_loads_nothing_heavy():
    code = "import sys, nurbeam; print([m for m in ('matplotlib', 'pandas', 'xarray', 'scipy', 'tqdm') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip() == "[]"
