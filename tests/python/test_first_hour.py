"""What people try in their first hour: points, sections by name, results by name, wrong words."""

import json
import math

import numpy as np
import pytest

import nurbeam as nb


def helix(count):
    turn = np.linspace(0, 5, count)
    return np.stack([0.02 * np.cos(2 * np.pi * turn), 0.02 * np.sin(2 * np.pi * turn), 0.012 * turn], axis=1)


def bar(**keys):
    model = nb.Model(gravity=[0, 0, 0])
    beam = model.add_beam([[0, 0, 0], [1, 0, 0]], section=nb.Circle("10 mm"), material="steel", elements=1, name="b", **keys)
    model.add_support(beam, at="start")
    model.add_support(beam, at="end")
    model.add_load(beam, force_per_length=[0, 0, -10])
    return model


def test_a_curve_goes_through_points():
    points = helix(81)
    curve = nb.Curve.through(points)
    assert abs(curve.length / (5 * math.hypot(2 * math.pi * 0.02, 0.012)) - 1) < 3e-5
    assert max(curve.closest_point(p).distance for p in points[::10]) < 1e-12
    ring = nb.Curve.through([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], closed=True)
    assert np.allclose(ring(ring.start), ring(ring.end))
    straight = nb.Curve.through([[0, 0, 0], [1, 0, 0]])
    assert straight.degree == 1
    with pytest.raises(ValueError, match="point 2"):
        nb.Curve.through([[0, 0, 0], [0, 0, 0], [1, 0, 0]])


def test_a_circle_is_exact():
    circle = nb.Curve.circle([0, 0, 1], 2, normal=[0, 1, 0])
    assert abs(circle.length - 4 * math.pi) < 1e-12
    assert np.allclose(circle.curvature(np.linspace(circle.start, circle.end, 9)[1:-1]), 0.5)
    with pytest.raises(ValueError, match="radius"):
        nb.Curve.circle([0, 0, 0], -1)


def test_curves_are_joined_split_moved_and_measured():
    a, b = nb.Curve.line([0, 0, 0], [1, 0, 0]), nb.Curve.line([1, 0, 0], [1, 2, 0])
    whole = a.join(b)
    assert abs(whole.length - 3) < 1e-12
    u = whole.parameter_at([0, 1, 2.5, 3])
    assert np.allclose(whole(u), [[0, 0, 0], [1, 0, 0], [1, 1.5, 0], [1, 2, 0]])
    parts = whole.split_at(float(u[2]))
    assert [round(part.length, 9) for part in parts] == [2.5, 0.5]
    with pytest.raises(ValueError, match="apart"):
        a.join(nb.Curve.line([2, 0, 0], [3, 0, 0]))
    turned = a.transformed([[0, -1, 0, 5], [1, 0, 0, 0], [0, 0, 1, 0]])
    assert np.allclose(turned(turned.end), [5, 1, 0])
    with pytest.raises(ValueError, match="shape"):
        a.transformed(np.eye(2))
    with pytest.raises(ValueError, match="not on the curve"):
        a.parameter_at(1.5)
    for beyond in (0, 7):
        with pytest.raises(ValueError, match="lie between 0 and 1"):
            a.split_at(beyond)


def test_curves_go_to_json_and_back():
    curve = nb.Curve.circle([0, 0, 0], 1, name="ring")
    back = nb.Curve.from_dict(json.loads(json.dumps(curve.to_dict())))
    assert back.name == "ring" and np.array_equal(back.control_points, curve.control_points)
    assert np.array_equal(back.weights, curve.weights) and back.degree == curve.degree
    with pytest.raises(KeyError, match='did you mean "knots"'):
        nb.Curve.from_dict({**curve.to_dict(), "knotz": 1})


def test_sections_have_names():
    assert nb.Pipe("24 mm", wall="3.2 mm") == {"radius": "24 mm", "bore": "20.8 mm"}
    assert nb.Pipe(0.024, bore=0.02) == {"radius": 0.024, "bore": 0.02}
    for section in (nb.Rectangle(0.1, "20 cm"), nb.IBeam("200 mm", "100 mm", "8.5 mm", "5.6 mm"), nb.Rope("16 mm", "110 mm^2"),
                    nb.Pipe(0.05, 0.005)):  # fmt: skip
        model = nb.Model()
        model.add_beam([[0, 0, 0], [9, 0, 0]], section=section, material="steel")
        assert model.summary()["beams"]
    for wrong in (lambda: nb.Circle(-1), lambda: nb.Rectangle(0.1, 0), lambda: nb.Pipe(0.1, wall=0.2)):
        with pytest.raises(ValueError, match="must be greater"):
            wrong()
    with pytest.raises(TypeError, match="either wall or bore"):
        nb.Pipe(0.1)


def test_wrong_words_complain_where_they_stand():
    with pytest.raises(TypeError, match='did you mean "gravity"'):
        nb.Model(gravty=[0, 0, 0])
    with pytest.raises(FileNotFoundError):
        nb.read("nix.step")
    with pytest.raises(FileNotFoundError):
        nb.load("nix.json")


@pytest.mark.parametrize(
    "wrong, says",
    [
        (lambda m, b: nb.Circle("6 mn"), 'did you mean "mm"'),
        (lambda m, b: nb.Circle("6 kg"), "radius"),
        (lambda m, b: nb.Section(radus=0.1), 'did you mean "radius"'),
        (lambda m, b: nb.Pipe("6 mm", bore="8 mm"), "bore is '8 mm' and radius '6 mm'"),
        (lambda m, b: nb.Pipe(0.006, bore=0.006), "must be less than the radius"),
        (lambda m, b: nb.Material("210 GPa", 7850), "density"),
        (lambda m, b: nb.Material(210e9, 7850), "density"),
        (lambda m, b: nb.Material(7850, 210e9, poisson_ratio=0.3), 'did you mean "poissons_ratio"'),
        (lambda m, b: m.add_beam([[0, 0, 0], [1, 0, 0]], section=nb.Circle(0.01), material="stell"), 'did you mean "steel"'),
        (lambda m, b: m.add_support(b, at="start", type="fixed"), 'did you mean "clamped"'),
        (lambda m, b: m.add_support(b, at="start", type="hinge"), 'did you mean "pinned"'),
        (lambda m, b: m.add_support(b, at="start", type="roller"), 'did you mean "guided"'),
        (lambda m, b: m.add_support(b, at="middle"), '"fraction": 0.5'),
        (lambda m, b: m.add_load(b, at="end", force=-100), r"force: is the number -100; expected \[x, y, z\]"),
        (lambda m, b: m.add_load(b, at="end", force=[0, 0, -1], moment=[0, 1, 0]), "exclude each other"),
        (lambda m, b: m.add_body("ball", mass="80,5 kg"), "mass"),
        (lambda m, b: m.add_body("ball", mass=math.nan), "mass: is nan"),
        (lambda m, b: m.add_probe("p", b, at="middle"), "probes: at: "),
    ],
)
def test_wrong_values_complain_where_they_stand(wrong, says):
    model = bar()
    before = json.dumps(model.case)
    with pytest.raises(ValueError, match=says):
        wrong(model, "b")
    assert json.dumps(model.case) == before


@pytest.mark.parametrize(
    "path, value, says",
    [
        ("beams[0].section.radius", "6 mn", r'beams\[0\].section.radius: .*did you mean "mm"'),
        ("beams.b.section.radius", -1, r"beams\[0\].section.radius: "),
        ("beams[0].section", {"radus": 1}, r'beams\[0\].section.radus: .*did you mean "radius"'),
        ("supports[1].type", "fixed", 'did you mean "clamped"'),
        ("supports[1]", {"beam": "b", "at": "ent"}, r"supports\[1\].at: "),
        ("gravity", -9.81, "gravity: is the number -9.81"),
        ("gravity[2]", math.nan, r"gravity\[2\]: is nan; expected a finite number"),
        ("loads[0].force_per_length", [0, "9 kg", 0], r"loads\[0\].force_per_length"),
    ],
)
def test_a_wrong_value_is_not_set(path, value, says):
    model = bar()
    before = json.dumps(model.case)
    with pytest.raises(nb.CaseError, match=says):
        model.set(path, value)
    assert json.dumps(model.case) == before


def test_a_value_is_set_beside_what_is_wrong_or_missing_elsewhere():
    model = bar()
    model.case["supports"][0]["at"] = "ent"
    model.set("beams[0].section.radius", "7 mm")
    model.set("supports[0].at", "start")
    model.set("beams[0].section.area", 1e-4)  # excludes the radius, which goes next
    model.set("beams[0].section.radius", None)
    model.set("beams[0].section.second_moment", 1e-9)
    model.set("beams[0].material", {"density": 7850})
    assert model.case["beams"][0]["section"] == {"area": 1e-4, "second_moment": 1e-9}


def test_a_list_that_no_case_has_is_refused():
    with pytest.raises(TypeError, match='did you mean "loads"'):
        bar().add("load", beam="b")
    item = bar().add("loads", beam="b", at="end")
    item["force"] = [0, 0, -1]  # what an item lacks may come later


def test_lengths_may_have_units():
    curve = nb.Curve.line([0, 0, 0], [2, 0, 0])
    assert np.allclose(curve(curve.parameter_at("50 cm")), [0.5, 0, 0])
    with pytest.raises(ValueError, match="unit"):
        curve.parameter_at("50 kg")
    assert nb.Pipe("1 in", wall="2.4 mm")["bore"] == pytest.approx(0.023)


def test_connectors_are_added_by_their_ends():
    model = nb.Model()
    cable = model.add_beam([[0, 0, 0], [9, 0, 0]], section=nb.Circle("6 mm"), material="steel", elements=4)
    model.add_support(cable, at="start")
    model.add_support(cable, at="end")
    weight = model.add_body("weight", mass=5, position=[4.5, 0, -1])
    model.add_rod("strap", {"beam": cable, "at": 4.5}, weight)
    model.add_connector("tie", "spring", weight, [4.5, 3, -1], stiffness=10)
    assert model.case["connectors"][0]["to"] == {"body": "weight"}
    assert model.case["connectors"][1]["to"] == {"point": [4.5, 3, -1]}
    model.check(type="static")


def test_results_are_read_by_number_by_slice_and_by_name():
    results = bar().run(type="static")
    assert isinstance(results[0], nb.Snapshot) and isinstance(results[:], list)
    assert np.array_equal(results["b.moment.max"], results.histories["b.moment.max"])
    sag = 5 * 10 / (384 * 2.1e11 * math.pi / 4 * 1e-8)
    extreme = results.extremes["b.displacement.max"]
    assert abs(extreme.value / sag - 1) < 1e-3 and abs(extreme.s - 0.5) < 1e-3
    with pytest.raises(KeyError, match="no extreme"):
        results.extremes["b.displacment"]


def test_the_report_page_goes_into_a_file(tmp_path):
    results = bar().run(type="static", out=tmp_path / "out")
    results.report(tmp_path / "x.html")
    assert (tmp_path / "x.html").read_bytes() == (tmp_path / "out" / "report.html").read_bytes()
    assert results.report["status"] == "done"
    assert results.extremes["b.displacement.max"].value > 7e-5
    with pytest.raises(ValueError, match="html"):
        results.report(tmp_path / "x.pdf")


def test_what_is_not_there_is_no_file(tmp_path):
    for ask in (lambda: nb.Results(tmp_path / "none"), lambda: nb.study(tmp_path / "none.json")):
        with pytest.raises(FileNotFoundError, match="none"):
            ask()


def test_deflections_are_shown_larger():
    shape = bar().run(type="static")[-1].beams["b"]
    drawn, now, larger = (shape.points(exaggerate=factor) for factor in (0, 1, 50))
    assert np.allclose(drawn[:, 2], 0, atol=1e-15) and np.allclose(now, shape.points())
    assert np.allclose(larger - drawn, 50 * (now - drawn), atol=1e-12)
    assert np.allclose(shape.exaggerated(0).control_points[:, 2], 0, atol=1e-15)


def test_results_in_memory_have_a_page(tmp_path):
    results = bar().run(type="static")
    results.report(tmp_path / "x.html")
    page = (tmp_path / "x.html").read_text(encoding="utf-8")
    assert "displacement.max" in page and "<title>model</title>" in page and "{{data}}" not in page
    shown = results._repr_html_()
    assert shown.startswith("<iframe srcdoc=") and shown.count('"') == 4
    drawn = bar()._repr_html_()
    assert drawn.startswith("<iframe") and "&quot;status&quot;:&quot;drawn&quot;" in drawn.replace(" ", "")
    assert '"name":"b","curve"' in page


def test_results_move(tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    model = bar()
    results = model.run(end_time=0.01, step=1e-3, every=2e-3)
    results.animate(tmp_path / "bar.gif")
    assert (tmp_path / "bar.gif").read_bytes().startswith(b"GIF8")
    results.animate(tmp_path / "bar.html")
    page = (tmp_path / "bar.html").read_text(encoding="utf-8")
    assert "https:" not in page and "http:" not in page and 'class="fa' not in page and page.count("<button") == 9
    with pytest.raises(ValueError, match="known are .gif"):
        results.animate(tmp_path / "bar.avi")
