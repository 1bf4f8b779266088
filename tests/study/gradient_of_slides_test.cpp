#include <gtest/gtest.h>

#include "tests/study/study_of_case.h"

namespace nurbeam {
namespace {

using test::expect_gradient;
using test::plane_slide;
using test::slide_study;
using test::StudyOfCase;

TEST(Gradient, OfASlidingBodyBeforeAnyEvent) {
  StudyOfCase of(plane_slide + R"json("analysis": {"type": "dynamic", "end_time": 0.03, "step": "1 ms"},
    "output": {"every": 0.01}})json",
                 slide_study + R"json(
    "quantities": [{"name": "s", "value": "at(end, slider.s)"}, {"name": "v", "value": "max(slider.speed)"},
      {"name": "z", "value": "at(end, slider.z)"}],
    "plan": {"grid": 2})json");
  // The derivative of the greatest speed has 1e-5 of round-off: a drawn curve is differentiated by
  // differences.
  expect_gradient(of, 0.01, 2e-5);
}

// When it would arrive changes with the curve and the speed, but the run ends before.
TEST(Gradient, OfABodyThatIsDrivenAlong) {
  std::string driven = plane_slide;
  driven.replace(driven.find(R"("speed": 1)"), 10, R"("motion": {"speed": 1.5})");
  StudyOfCase of(driven + R"json("analysis": {"type": "dynamic", "end_time": 0.03, "step": "1 ms"},
    "output": {"every": 0.01}})json",
                 R"json("variables": [
      {"name": "z2", "control_point": {"beam": "beam", "index": 2, "axis": "z"}, "range": [-0.9, -0.5]},
      {"name": "speed", "path": "sliding_joints[0].motion.speed", "range": [1, 2]}],
    "quantities": [{"name": "s", "value": "at(end, slider.s)"}, {"name": "z", "value": "at(end, slider.z)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.01, 1e-5);
}

TEST(Gradient, AcrossChangesOfTheMesh) {
  StudyOfCase of(plane_slide + R"json("analysis": {"type": "dynamic", "end_time": 0.4, "step": "1 ms"},
    "output": {"every": 0.1}})json",
                 slide_study + R"json(
    "quantities": [{"name": "s", "value": "at(end, slider.s)"}, {"name": "v", "value": "max(slider.speed)"},
      {"name": "z", "value": "at(end, slider.z)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 1e-4, 1e-4);
}

// A curve that gets longer before the bodies: their elements, which begin at its home nodes and end at the
// same place in metres, are strained most of all. The mesh changes twice.
TEST(Gradient, OfBodiesBehindAKnotThatMoves) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.4, 1, 1, 1, 1], "weights": [1, 1.1, 0.9, 1.05, 1],
                         "control_points": [[0, 0, 1], [0.8, 0, 0.3], [1.7, 0, 0.15], [2.9, 0, 0.2], [3.6, 0, 0.7]]}},
      "section": {"radius": "14 mm"}, "material": {"density": 1900, "youngs_modulus": "6 GPa"},
      "elements": {"count": 14}}],
    "bodies": [{"name": "a", "mass": 0.7}, {"name": "b", "mass": 1.9}],
    "sliding_joints": [{"body": "a", "beam": "beam", "at": {"length": 0.45}, "speed": 0.6},
                       {"body": "b", "beam": "beam", "at": {"length": 1.52}, "speed": 0.9}],
    "supports": [{"beam": "beam", "at": "start", "type": "pinned"}, {"beam": "beam", "at": "end", "type": "clamped"}],
    "analysis": {"type": "dynamic", "end_time": 0.1, "step": "1 ms"}, "output": {"every": 0.1}})json",
                 R"json("variables": [
      {"name": "z2", "control_point": {"beam": "beam", "index": 2, "axis": "z"}, "range": [0, 0.3]},
      {"name": "w1", "weight": {"beam": "beam", "index": 1}, "range": [0.9, 1.3]}],
    "quantities": [{"name": "s", "value": "at(end, a.s)"}, {"name": "v", "value": "at(end, b.speed)"},
      {"name": "z", "value": "at(end, b.z)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 1e-4, 1e-4);
}

// It stands on the first node of an element that a control point changes, as a point of the one before.
TEST(Gradient, OfABodyCarriedAsAPointThatStandsOnANode) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1],
        "control_points": [[0, 0, 0.8], [0.4, 0, 0.6], [0.9, 0, 0.4], [1.5, 0, 0.3], [2.1, 0, 0.4], [2.6, 0, 0.6], [3, 0, 0.8]]}},
      "section": {"radius": "14 mm"}, "material": {"density": 1900, "youngs_modulus": "6 GPa"},
      "elements": {"count": 4}}],
    "bodies": [{"name": "a", "mass": 0.7}],
    "sliding_joints": [{"body": "a", "beam": "beam", "at": {"fraction": 0.5}, "speed": 1.5, "carried_as": "point"}],
    "supports": [{"beam": "beam", "at": "start", "type": "pinned"}, {"beam": "beam", "at": "end", "type": "clamped"}],
    "analysis": {"type": "dynamic", "end_time": 0.08, "step": "1 ms"}, "output": {"every": 0.08}})json",
                 R"json("variables": [
      {"name": "z5", "control_point": {"beam": "beam", "index": 5, "axis": "z"}, "range": [0.5, 0.7]},
      {"name": "z6", "control_point": {"beam": "beam", "index": 6, "axis": "z"}, "range": [0.7, 0.9]}],
    "quantities": [{"name": "s", "value": "at(end, a.s)"}, {"name": "v", "value": "at(end, a.speed)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 1e-3, 1e-3);  // accelerations jump there
}

// A body on a beam of eight spans, three elements in each.
std::string spans_case(const char* length, const char* speed, const char* end) {
  return R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3,
                         "knots": [0, 0, 0, 0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1, 1, 1, 1],
                         "control_points": [[0.0, 0, 1.0], [0.36, 0, 0.806], [0.72, 0, 0.625], [1.08, 0, 0.466], [1.44, 0, 0.34],
                                            [1.8, 0, 0.25], [2.16, 0, 0.2], [2.52, 0, 0.186], [2.88, 0, 0.205], [3.24, 0, 0.246], [3.6, 0, 0.3]]}},
      "section": {"radius": "14 mm"}, "material": {"density": 1900, "youngs_modulus": "6 GPa"},
      "elements": {"count": 24}}],
    "bodies": [{"name": "a", "mass": 0.7}],
    "sliding_joints": [{"body": "a", "beam": "beam", "at": {"length": )json" +
         std::string(length) + R"json(}, "speed": )json" + speed + R"json(}],
    "supports": [{"beam": "beam", "at": "start", "type": "pinned"}, {"beam": "beam", "at": "end", "type": "clamped"}],
    "analysis": {"type": "dynamic", "end_time": )json" +
         end + R"json(, "step": "1 ms"}, "output": {"every": 0.05}})json";
}

// Control points that move spans before the body alone: its own are drawn alike, only further on.
TEST(Gradient, OfABodyOnSpansThatAreDrawnAlike) {
  StudyOfCase of(spans_case("2.3", "1.6", "0.15"),
                 R"json("variables": [
      {"name": "z1", "control_point": {"beam": "beam", "index": 1, "axis": "z"}, "range": [0.7, 0.9]},
      {"name": "z2", "control_point": {"beam": "beam", "index": 2, "axis": "z"}, "range": [0.5, 0.7]}],
    "quantities": [{"name": "s", "value": "at(end, a.s)"}, {"name": "v", "value": "at(end, a.speed)"},
      {"name": "z", "value": "at(end, a.z)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 1e-4, 1e-4);
}

// Control points of spans that the body has left, comes to and never sees: their models go without the
// changes of the mesh that do not touch what they draw, have their meshes made where the body is with them,
// and go without again. Breaks are passed as a point.
TEST(Gradient, OfControlPointsThatABodyComesToAndLeaves) {
  StudyOfCase of(spans_case("0.6", "4", "0.3"), R"json("variables": [
      {"name": "z1", "control_point": {"beam": "beam", "index": 1, "axis": "z"}, "range": [0.75, 0.85]},
      {"name": "z3", "control_point": {"beam": "beam", "index": 3, "axis": "z"}, "range": [0.4, 0.5]},
      {"name": "z5", "control_point": {"beam": "beam", "index": 5, "axis": "z"}, "range": [0.2, 0.3]},
      {"name": "z8", "control_point": {"beam": "beam", "index": 8, "axis": "z"}, "range": [0.15, 0.25]}],
    "quantities": [{"name": "s", "value": "at(end, a.s)"}, {"name": "v", "value": "at(end, a.speed)"},
      {"name": "z", "value": "at(0.2, a.z)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 1e-4, 1e-4);
}

TEST(Gradient, OfABodyOnARailWithTorsion) {
  StudyOfCase of(test::rail_case(R"json({"radius": "16 mm"})json"), test::rail_study);
  expect_gradient(of, 1e-4, 1e-4);
}

// Sections that differ by how they are turned about the tangent.
TEST(Gradient, OfABodyOnARailWithTorsionWhoseSectionIsFlat) {
  StudyOfCase of(test::rail_case(R"json({"area": 6.4e-4, "second_moments": [8.5e-8, 1.4e-8],
      "torsion_constant": 4.2e-8})json"),
                 test::rail_study);
  expect_gradient(of, 1e-4, 1e-4);
}

// As accurate as with narrow ones: a step of as much would strain slender elements by more than they are.
TEST(Gradient, OfControlPointsWithWideRanges) {
  StudyOfCase of(spans_case("0.6", "4", "0.3"), R"json("variables": [
      {"name": "z1", "control_point": {"beam": "beam", "index": 1, "axis": "z"}, "range": [0.3, 1.3]},
      {"name": "z3", "control_point": {"beam": "beam", "index": 3, "axis": "z"}, "range": [-0.05, 0.95]},
      {"name": "z5", "control_point": {"beam": "beam", "index": 5, "axis": "z"}, "range": [-0.25, 0.75]},
      {"name": "z8", "control_point": {"beam": "beam", "index": 8, "axis": "z"}, "range": [-0.3, 0.7]}],
    "quantities": [{"name": "s", "value": "at(end, a.s)"}, {"name": "v", "value": "at(end, a.speed)"},
      {"name": "z", "value": "at(0.2, a.z)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 1e-5, 1e-4);
}

// A moving node comes to the one that its element ends with: the last step before it is shortened, by a
// length that is another where the body comes sooner.
TEST(Gradient, OfAStepThatTheElementLeftShortens) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.5, 1, 1, 1, 1], "weights": [1, 0.9, 1.1, 1, 1],
                         "control_points": [[0, 0, 0.9], [0.7, 0, 0.5], [1.3, 0, 0.3], [1.9, 0, 0.2], [2.7, 0, 0]]}},
      "section": {"radius": "18 mm"}, "material": {"density": 2700, "youngs_modulus": "8 GPa"},
      "elements": {"count": 14}}],
    "bodies": [{"name": "bead", "mass": 0.9}],
    "sliding_joints": [{"body": "bead", "beam": "beam", "at": {"length": 1.36}, "speed": 3}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped"}, {"beam": "beam", "at": "end", "type": "clamped"}],
    "analysis": {"type": "dynamic", "end_time": 0.03, "step": "1 ms"}, "output": {"every": 0.03}})json",
                 R"json("variables": [
      {"name": "speed", "path": "sliding_joints[0].speed", "range": [2.8, 3.2]}],
    "quantities": [{"name": "s", "value": "at(end, bead.s)"}, {"name": "v", "value": "at(end, bead.vx)"},
      {"name": "U", "value": "at(end, energy.bending)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 1e-3, 1e-5);
}

TEST(Gradient, OfTheTimeAtWhichABodyLeaves) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "rail", "rigid": true,
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.5, 1, 1, 1, 1], "weights": [1, 0.9, 1.1, 1, 1],
                         "control_points": [[0, 0, 2], [0.5, 0, 1], [1.5, 0, 0.5], [2.5, 0, 0], [3.14, 0, 0]]}}}],
    "bodies": [{"name": "bead", "mass": 1}],
    "sliding_joints": [{"body": "bead", "beam": "rail", "at": "start", "speed": 0.1, "at_beam_end": "leave"}],
    "analysis": {"type": "dynamic", "end_time": 1.5, "step": "2 ms"}, "output": {"every": 0.1}})json",
                 R"json("variables": [
      {"name": "z1", "control_point": {"beam": "rail", "index": 1, "axis": "z"}, "range": [0.8, 1.2]},
      {"name": "x2", "control_point": {"beam": "rail", "index": 2, "axis": "x"}, "range": [1.2, 1.7]},
      {"name": "w1", "weight": {"beam": "rail", "index": 1}, "range": [0.6, 1.2]},
      {"name": "speed", "path": "sliding_joints[0].speed", "range": [0.05, 0.2], "nominal": 0.1}],
    "quantities": [{"name": "time", "value": "time(leaves, bead)"}, {"name": "x", "value": "at(end, bead.x)"},
      {"name": "z", "value": "at(end, bead.z)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.002, 1e-4);
}

// A trolley on a hanging cable that hardly resists bending.
TEST(Gradient, OfARideThatBeginsAtRest) {
  StudyOfCase of(
      R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "cable", "stress_free": "straight",
      "axis": {"nurbs": {"degree": 2, "knots": [0, 0, 0, 1, 1, 1], "weights": [1, 1, 1],
                         "control_points": [[0, 0, 4], [10, 0, -0.5], [20, 0, 0]]}},
      "section": {"radius": "6 mm"}, "material": {"density": 5200, "youngs_modulus": "60 GPa"},
      "elements": {"count": 12}}],
    "bodies": [{"name": "trolley", "mass": 80}],
    "supports": [{"beam": "cable", "at": "start", "type": "pinned"}, {"beam": "cable", "at": "end", "type": "pinned"}],
    "sliding_joints": [{"body": "trolley", "beam": "cable", "at": {"length": 3.3}, "slope": "discontinuous"}],
    "analysis": {"type": "dynamic", "initial": "equilibrium", "end_time": 0.8, "step": "4 ms"},
    "output": {"every": 0.2}})json",
      R"json("variables": [
      {"name": "height", "control_point": {"beam": "cable", "index": 0, "axis": "z"}, "range": [3, 5]},
      {"name": "sag", "control_point": {"beam": "cable", "index": 1, "axis": "z"}, "range": [-1, 0]},
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [4e10, 8e10]},
      {"name": "mass", "path": "bodies[0].mass", "range": [60, 100]},
      {"name": "place", "path": "sliding_joints[0].at.length", "range": [3, 3.6]}],
    "quantities": [{"name": "s", "value": "at(end, trolley.s)"}, {"name": "v", "value": "at(end, trolley.speed)"},
      {"name": "tension", "value": "at(end, cable.axial_force.max)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 1e-4, 1e-4);
}

// The body stops at the end where it is before the first step.
TEST(Gradient, OfABodyThatStartsAtTheEndOfItsBeam) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "rod", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": "1 cm"},
      "material": {"density": 1200, "youngs_modulus": "5 MPa"}, "elements": {"count": 8}}],
    "bodies": [{"name": "bob", "mass": "200 g"}],
    "supports": [{"beam": "rod", "at": "start", "type": "pinned"}],
    "sliding_joints": [{"body": "bob", "beam": "rod", "at": "end", "at_beam_end": "stop"}],
    "analysis": {"type": "dynamic", "end_time": 0.2, "step": "2 ms"}, "output": {"every": 0.05}})json",
                 R"json("variables": [
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [3e6, 8e6]},
      {"name": "mass", "path": "bodies[0].mass", "range": [0.1, 0.3]}],
    "quantities": [{"name": "z", "value": "at(end, bob.z)"}, {"name": "vx", "value": "at(end, bob.vx)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.004, 1e-4);
}

// Elements whose ends move have the kink of what tension damps too.
TEST(Gradient, OfABodyOnABeamWhoseTensionIsDamped) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0, 0], [3, 0, 0]]}},
      "section": {"radius": "20 mm"},
      "material": {"density": 7800, "youngs_modulus": "2 GPa", "stiffness_damping": 0.001}, "elements": {"count": 12}}],
    "bodies": [{"name": "slider", "mass": 5}],
    "sliding_joints": [{"body": "slider", "beam": "beam", "at": {"length": 1.3}, "speed": 1}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"}],
    "analysis": {"end_time": 0.06, "step": "0.5 ms"},
    "output": {"every": 0.01, "probes": [{"name": "mid", "beam": "beam", "at": {"fraction": 0.5}}]}})json",
                 R"json("variables": [
      {"name": "x", "control_point": {"beam": "beam", "index": 1, "axis": "x"}, "range": [2.9, 3.1]}],
    "quantities": [{"name": "z", "value": "at(end, mid.z)"}, {"name": "force", "value": "at(end, root.fz)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.005, 1e-4);
}

}  // namespace
}  // namespace nurbeam
