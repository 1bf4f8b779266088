#include "pipelines/study/gradient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/study/study_of_case.h"

namespace nurbeam {
namespace {

using test::expect_gradient;
using test::plane_beam;
using test::space_beam;
using test::space_study;
using test::spline_case;
using test::StudyOfCase;

TEST(Gradient, OfAPlaneCantileverAtRest) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], )json" + plane_beam + R"json(,
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"}],
    "analysis": {"type": "static"},
    "output": {"probes": [{"name": "tip", "beam": "beam", "at": "end"}]}})json",
                 R"json("variables": [
      {"name": "z2", "control_point": {"beam": "beam", "index": 2, "axis": "z"}, "range": [0, 0.6]},
      {"name": "x1", "control_point": {"beam": "beam", "index": 1, "axis": "x"}, "range": [0.8, 1.2]},
      {"name": "w1", "weight": {"beam": "beam", "index": 1}, "range": [0.6, 1.2]},
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]},
      {"name": "radius", "path": "beams[0].section.radius", "range": [0.015, 0.025]},
      {"name": "density", "path": "beams[0].material.density", "range": [2600, 2800]}],
    "quantities": [{"name": "sag", "value": "at(end, tip.uz)"}, {"name": "root", "value": "at(end, beam.moment.max)"},
      {"name": "bending", "value": "at(end, energy.bending)"}, {"name": "x", "value": "at(end, tip.x)^2 + sqrt(z2)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.004, 1e-6);
}

TEST(Gradient, OfAPlaneMotion) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], )json" + plane_beam + R"json(,
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"}],
    "analysis": {"type": "dynamic", "end_time": 0.1, "step": "2 ms"},
    "output": {"every": 0.02, "probes": [{"name": "tip", "beam": "beam", "at": "end"}]}})json",
                 R"json("variables": [
      {"name": "z2", "control_point": {"beam": "beam", "index": 2, "axis": "z"}, "range": [0, 0.6]},
      {"name": "w1", "weight": {"beam": "beam", "index": 1}, "range": [0.6, 1.2]},
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]},
      {"name": "radius", "path": "beams[0].section.radius", "range": [0.015, 0.025]},
      {"name": "density", "path": "beams[0].material.density", "range": [2600, 2800]}],
    "quantities": [{"name": "z", "value": "at(end, tip.z)"}, {"name": "speed", "value": "max(tip.speed)"},
      {"name": "length", "value": "at(end, beam.length)"}, {"name": "work", "value": "integral(tip.vz)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.004, 1e-5);
}

TEST(Gradient, ByControlPointsThatReachOnlySomeElements) {
  const std::string study = R"json("variables": [
      {"name": "z3", "control_point": {"beam": "beam", "index": 3, "axis": "z"}, "range": [0.2, 0.6]},
      {"name": "x8", "control_point": {"beam": "beam", "index": 8, "axis": "x"}, "range": [1.7, 2.1]},
      {"name": "density", "path": "beams[0].material.density", "range": [2600, 2800]}],
    "quantities": [{"name": "z", "value": "at(end, tip.z)"}, {"name": "m", "value": "at(end, root.my)"}],
    "plan": {"grid": 2})json";
  StudyOfCase motion(spline_case(13, 40, R"json({"type": "dynamic", "end_time": 0.04, "step": "2 ms"})json"),
                     study);
  expect_gradient(motion, 0.004, 1e-5);
  StudyOfCase rest(spline_case(13, 40, R"json({"type": "static"})json"), study);
  expect_gradient(rest, 0.004, 1e-6);
}

// An arc of a circle in even spans, with fewer elements than three for each: which spans get fewer is decided
// by round-off, and otherwise in each neighbour.
TEST(Gradient, OfAMeshThatNeighboursWouldDivideOtherwise) {
  std::ostringstream control;
  for (int i = 0; i < 11; ++i)
    control << (i > 0 ? ", [" : "[") << std::cos(0.25 * i) << ", " << std::sin(0.25 * i) << ", " << 0.05 * i
            << "]";
  const std::string beam = R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "beam",
    "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1, 1, 1, 1],
                       "control_points": [)json" +
                           control.str() + R"json(]}},
    "section": {"rectangle": [0.04, 0.02]}, "orientation": {"up": [0, 0, 1]},
    "material": {"density": 2700, "youngs_modulus": "2 GPa", "poissons_ratio": 0.3}, "elements": {"count": 24}}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"}],
    "output": {"probes": [{"name": "tip", "beam": "beam", "at": "end"}]}, "analysis": {"type": "static"}})json";
  const std::string by = R"json("variables": [
    {"name": "z7", "control_point": {"beam": "beam", "index": 7, "axis": "z"}, "range": [0.25, 0.45], "nominal": 0.35}],
    "quantities": [{"name": "sag", "value": "at(end, tip.uz)"}], "plan": {"gradient": "nominal"})json";
  StudyOfCase of(beam, by);
  // Of another mesh, whose spans are told apart.
  std::string fine = beam;
  fine.replace(fine.find("\"count\": 24"), 11, "\"per_segment\": 3");
  StudyOfCase like(fine, by);
  const double g = of.run({0.35}, true).gradient[0][0], expected = like.run({0.35}, true).gradient[0][0];
  EXPECT_NEAR(g, expected, 1e-3 * std::abs(expected));
  expect_gradient(like, 0.01, 1e-6);
}

TEST(Gradient, OfABeamInSpaceWithTorsionAtRest) {
  StudyOfCase of(R"json({"nurbeam": 1, )json" + space_beam + R"json("analysis": {"type": "static"},
    "output": {"probes": [{"name": "tip", "beam": "beam", "at": "end"}]}})json",
                 space_study + R"json("quantities": [{"name": "sag", "value": "at(end, tip.uz)"},
      {"name": "aside", "value": "at(end, tip.ux)"}, {"name": "torque", "value": "at(end, root.mx)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.01, 1e-6);
}

TEST(Gradient, OfAMotionInSpaceWithTorsion) {
  StudyOfCase of(R"json({"nurbeam": 1, )json" + space_beam + R"json(
    "analysis": {"type": "dynamic", "end_time": 0.06, "step": "2 ms"},
    "output": {"every": 0.02, "probes": [{"name": "tip", "beam": "beam", "at": "end"}]}})json",
                 space_study + R"json("quantities": [{"name": "z", "value": "at(end, tip.z)"},
      {"name": "y", "value": "at(end, tip.y)"}, {"name": "speed", "value": "max(tip.speed)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.004, 1e-5);
}

// Sections turn by more than a right angle: charts are those of the rest before, and on the way other ones.
TEST(Gradient, OfRestsWhoseSectionsTurnFar) {
  StudyOfCase of("{\"nurbeam\": 1, " + space_beam + R"json(
    "loads": [{"beam": "beam", "at": "end", "force": [20, 0, -90], "time": [[0, 0], [1, 1]]}],
    "analysis": {"type": "static", "load_steps": [0.5, 1]},
    "output": {"probes": [{"name": "tip", "beam": "beam", "at": "end"}]}})json",
                 space_study + R"json("quantities": [{"name": "z", "value": "at(end, tip.z)"},
      {"name": "y", "value": "at(end, tip.y)"}, {"name": "between", "value": "at(0.5, tip.x)"},
      {"name": "torque", "value": "at(end, root.my)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.004, 1e-6);
}

// As above, in a motion: where charts are exchanged its tangents go over to the new ones.
TEST(Gradient, OfAMotionWhoseSectionsTurnFar) {
  StudyOfCase of(R"json({"nurbeam": 1, )json" + space_beam + R"json(
    "loads": [{"beam": "beam", "at": "end", "force": [60, 0, -90]}],
    "analysis": {"type": "dynamic", "end_time": 0.3, "step": "2 ms"},
    "output": {"every": 0.05, "probes": [{"name": "tip", "beam": "beam", "at": "end"}]}})json",
                 space_study + R"json("quantities": [{"name": "z", "value": "at(end, tip.z)"},
      {"name": "y", "value": "at(0.25, tip.y)"}, {"name": "energy", "value": "at(end, energy.kinetic)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.002, 1e-5);
}

// Two components of the tangent at the clamp are equal, as where it is along an axis: beside it the clamp
// takes the same directions across.
TEST(Gradient, OfABeamThatIsClampedAlongAnAxis) {
  for (const char* control : {"[0.5, 0, 0]", "[0.4, 0.4, 0.4]"}) {
    StudyOfCase of(std::string(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1],
                         "control_points": [[0, 0, 0], )json") +
                       control + R"json(, [1, 0.8, 0.3], [0.9, 1.5, 0.5]]}},
      "section": {"radius": "12 mm"}, "material": {"density": 2700, "youngs_modulus": "7 GPa", "poissons_ratio": 0.3},
      "elements": {"count": 4}}],
      "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "A"}], "analysis": {"type": "static"},
      "output": {"probes": [{"name": "tip", "beam": "beam", "at": "end"}]}})json",
                   R"json("variables": [
      {"name": "y0", "control_point": {"beam": "beam", "index": 0, "axis": "y"}, "range": [-0.1, 0.1]},
      {"name": "y1", "control_point": {"beam": "beam", "index": 1, "axis": "y"}, "range": [-0.1, 0.6]}],
    "quantities": [{"name": "x", "value": "at(end, tip.x)"}, {"name": "m", "value": "at(end, A.mx)"}],
    "plan": {"grid": 2})json");
    expect_gradient(of, 2e-3, 1e-6);
  }
}

// Below a damping of zero there is no case.
TEST(Gradient, AtTheEndOfWhatThereIsLooksToOneSide) {
  StudyOfCase of(
      test::spline_case(6, 4, R"json({"type": "dynamic", "end_time": 0.1, "step": 0.005})json"),
      R"json("variables": [{"name": "d", "path": "beams[0].material.damping", "range": [0, 1e-3], "nominal": 0}],
    "quantities": [{"name": "z", "value": "at(end, tip.z)"}], "plan": {"gradient": "nominal"})json");
  const Variant at_end = of.run({0}, true);
  ASSERT_EQ(at_end.gradient.size(), 1U) << at_end.reason;
  const auto slope = [&](double h) { return (of.run({h}, false).quantities[0] - at_end.quantities[0]) / h; };
  const double coarse = slope(2e-5), fine = slope(1e-5);
  EXPECT_NEAR(at_end.gradient[0][0], 2 * fine - coarse, 1e-3 * std::abs(fine));
}

// A body on a level guide swings about the relaxed length of a spring: x = 2 + (v - 2) cos(w t), w^2 = k / 2.
// Its extremes of one swing and the next are told apart by the stored times alone.
TEST(Gradient, OfExtremesThatOtherTimesNearlyReach) {
  const std::string swing = R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "rail", "axis": {"polyline": [[0, 0, 0], [4, 0, 0]]}, "rigid": true}],
    "bodies": [{"name": "t", "mass": 2}],
    "sliding_joints": [{"body": "t", "beam": "rail", "at": {"length": 3}, "speed": 0}],
    "connectors": [{"name": "s", "from": {"point": [0, 0, 0]}, "to": {"body": "t"}, "stiffness": 50, "length": 2}],
    "analysis": {"end_time": 6, "step": 0.002}, "output": {"every": 0.02}})json";
  const std::string variables = R"json("variables": [
      {"name": "v", "path": "sliding_joints[0].at.length", "range": [2.5, 3.5], "nominal": 3},
      {"name": "k", "path": "connectors[0].stiffness", "range": [40, 60], "nominal": 50}], )json";
  const auto gradient = [&](const std::string& quantities) {
    StudyOfCase of(swing, variables + R"json("quantities": [)json" + quantities +
                              R"json(], "plan": {"gradient": "nominal"})json");
    return of.run(of.nominal(), true).gradient;
  };
  const std::string speed = R"json({"name": "speed", "value": "max(t.speed)"})json",
                    nearest = R"json({"name": "nearest", "value": "min(t.s)"})json",
                    swings = R"json({"name": "swings", "value": "max(t.s) - min(t.s)"})json";
  const StudyGradient by_tangents = gradient(speed + ", " + nearest + ", " + swings);
  const std::vector<std::vector<double>> exact{{5, 0.05}, {-1, 0}, {2, 0}};
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_NEAR(by_tangents[i][0], exact[i][0], 2e-3) << i;
    EXPECT_NEAR(by_tangents[i][1], exact[i][1], 0.008) << i << ": the stored times are 0.02 s apart";
  }
  for (const std::string& one : {speed, nearest, swings}) {
    const StudyGradient by_adjoint = gradient(one);
    const std::size_t i = one == speed ? 0 : one == nearest ? 1 : 2;
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(by_adjoint[0][k], by_tangents[i][k], 1e-4) << one << k;
  }
}

// Means over all times of what is greatest along the beam, at one place or another.
TEST(Gradient, OfExtremesAlongABeam) {
  StudyOfCase of(spline_case(8, 8, R"json({"type": "dynamic", "end_time": 0.1, "step": "2 ms"})json"),
                 R"json("variables": [
      {"name": "z3", "control_point": {"beam": "beam", "index": 3, "axis": "z"}, "range": [0.2, 0.6]},
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1.9e9, 2.1e9]}],
    "quantities": [{"name": "tension", "value": "mean(beam.axial_force.max)"},
      {"name": "pressure", "value": "mean(beam.axial_force.min)"},
      {"name": "moment", "value": "mean(beam.moment.max)"},
      {"name": "shear", "value": "mean(beam.shear_force.max)"}, {"name": "length", "value": "mean(beam.length)"},
      {"name": "far", "value": "mean(beam.displacement.max)"}, {"name": "sag", "value": "mean(beam.sag)"}],
    "plan": {"grid": 2})json");
  test::expect_gradient(of, 0.002, 1e-4);
}

// In its plane nothing is across it: all that is asked of is exactly zero.
TEST(Gradient, OfWhatIsZeroAsDrawn) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "b", "torsion": true, "elements": {"count": 5},
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1],
                         "control_points": [[0, 0, 0], [0.5, 0, 0.1], [1, 0, 0.3], [1.4, 0, 0.4]]}},
      "section": {"radius": 0.012}, "material": {"density": 2700, "youngs_modulus": 7e9}}],
    "supports": [{"beam": "b", "at": "start", "type": "clamped"}],
    "loads": [{"beam": "b", "at": "end", "force": [0, 0, -4]}], "analysis": {"type": "static"},
    "output": {"probes": [{"name": "tip", "beam": "b", "at": "end"}]}})json",
                 R"json("variables": [
      {"name": "y3", "control_point": {"beam": "b", "index": 3, "axis": "y"}, "range": [-0.1, 0.1]},
      {"name": "fy", "path": "loads[0].force[1]", "range": [-1, 1]}],
    "quantities": [{"name": "y", "value": "at(end, tip.y)"}], "plan": {"grid": 2})json");
  expect_gradient(of, 1e-2, 1e-5);
}

// Columns that change alike leave these as they are.
TEST(Gradient, OfRatiosAndAnglesOfColumns) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": "10 mm"},
      "material": {"density": 7800, "youngs_modulus": "210 GPa"}, "elements": {"count": 8}}],
    "supports": [{"beam": "b", "at": "start", "type": "pinned", "name": "L"},
                 {"beam": "b", "at": "end", "type": "guided", "direction": [1, 0, 0], "name": "R"}],
    "loads": [{"beam": "b", "at": {"fraction": 0.25}, "force": [0, 0, -10]},
              {"beam": "b", "at": {"fraction": 0.75}, "force": [0, 0, -10]}],
    "analysis": {"type": "static"}})json",
                 R"json("variables": [{"name": "P", "path": "loads[0].force[2]", "range": [-20, -5]}],
    "quantities": [{"name": "ratio", "value": "at(end, L.fz) / at(end, R.fz)"},
                   {"name": "angle", "value": "atan2(at(end, L.fz), at(end, R.fz))"}],
    "plan": {"grid": 3})json");
  expect_gradient(of, 1e-3, 1e-5);
}

// A straight beam of three metres that falls, an end of which moves along it.
std::string falling_beam(const char* damping, const char* others) {
  return std::string(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0, 0], [3, 0, 0]]}},
      "section": {"radius": "20 mm"}, "material": {"density": 7800, "youngs_modulus": "2 GPa")json") +
         damping + R"json(}, "elements": {"count": 16}}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"}], )json" +
         others + R"json("analysis": {"end_time": 0.06, "step": 0.0005},
    "output": {"every": 0.01, "probes": [{"name": "mid", "beam": "beam", "at": {"fraction": 0.5}}]}})json";
}

std::string by_its_end(const char* quantities) {
  return std::string(R"json("variables": [
      {"name": "x", "control_point": {"beam": "beam", "index": 1, "axis": "x"}, "range": [2.9, 3.1]},
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1.9e9, 2.1e9]}],
    "quantities": [)json") +
         quantities + R"json(], "plan": {"grid": 2})json";
}

// What tension damps has a kink where this comes to 0, and numbers of elements that change at the same
// coordinates strain them by more than all loads do: by tangents and, of one quantity, by adjoints.
TEST(Gradient, OfABeamWhoseTensionIsDamped) {
  const std::string falling =
      falling_beam(R"json(, "stiffness_damping": 0.001)json",
                   R"json("loads": [{"beam": "beam", "at": "end", "force": [0, 0, -5]}], )json");
  const char *place = R"json({"name": "z", "value": "at(end, mid.z)"})json",
             *force = R"json({"name": "root", "value": "at(end, root.fz)"})json",
             *along = R"json({"name": "along", "value": "at(end, mid.ux)"})json";
  StudyOfCase by_tangents(falling, by_its_end((std::string(place) + ", " + force + ", " + along).c_str()));
  expect_gradient(by_tangents, 0.01, 1e-4);
  StudyOfCase by_adjoints(falling, by_its_end(place));
  expect_gradient(by_adjoints, 0.01, 1e-4);
}

// It is as long as it is drawn, so that it is just about to pull.
TEST(Gradient, OfARopeThatIsDrawnTaut) {
  StudyOfCase of(falling_beam("", R"json("connectors": [{"name": "rope", "type": "tension-only",
      "from": {"beam": "beam", "at": {"fraction": 0.6}}, "to": {"point": [2.2, 0, 0.8]}, "stiffness": 5000}], )json"),
                 by_its_end(R"json({"name": "z", "value": "at(end, mid.z)"},
      {"name": "root", "value": "at(end, root.fz)"}, {"name": "rope", "value": "at(end, rope.force)"})json"));
  expect_gradient(of, 0.01, 1e-4);
}

// EA is a million times as large as the loads: the derivative is that of differences of whole runs however
// narrow its range is, and whichever way the control point is named.
TEST(Gradient, OfForcesByControlPointsWithNarrowRanges) {
  const auto by = [](const char* target, const char* range) {
    return StudyOfCase(
        R"json({"nurbeam": 1, "gravity": [-5.65, 3.37, -5.54], "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0, 0], [3, 0, -0.27]]}},
      "torsion": true, "section": {"area": 1e-3, "second_moments": [3e-8, 9e-8], "product": 2e-8, "torsion_constant": 4e-8},
      "material": {"density": 7800, "youngs_modulus": "210 GPa", "poissons_ratio": 0.3}, "elements": {"count": 24}}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "A"},
                 {"beam": "beam", "at": {"fraction": 0.54}, "type": "pinned", "name": "B"}],
    "loads": [{"beam": "beam", "at": "end", "force": [-11.5, 54, 45.6]}],
    "analysis": {"type": "static"}})json",
        std::string("\"variables\": [{\"name\": \"y\", ") + target + ", \"range\": " + range +
            R"json(}], "quantities": [{"name": "A", "value": "at(end, A.fz)"}], "plan": {"grid": 2})json");
  };
  const char *point = R"json("control_point": {"beam": "beam", "index": 0, "axis": "y"})json",
             *path = R"json("path": "beams[0].axis.nurbs.control_points[0][1]")json";
  StudyOfCase wide = by(point, "[-0.1, 0.1]");
  const auto force = [&](double y) { return wide.run({y}, false).quantities[0]; };
  constexpr double step = 2e-3;
  const double expected = (force(step) - force(-step)) / (2 * step);
  EXPECT_GT(std::abs(expected), 1);
  for (const char* target : {point, path})
    for (const char* range : {"[-1e-5, 1e-5]", "[-1e-3, 1e-3]", "[-0.1, 0.1]"}) {
      StudyOfCase of = by(target, range);
      EXPECT_NEAR(of.run({0}, true).gradient[0][0], expected, 1e-4 * std::abs(expected)) << target << range;
    }
}

// A force is a small difference of great numbers: EA is ten thousand times as large as the loads.
TEST(Gradient, OfForcesInAStiffCable) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "cable",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.5, 1, 1, 1, 1],
                         "control_points": [[0, 0, 0], [1, 0, -0.2], [3, 0, -0.33], [5, 0, -0.2], [6, 0, 0]]}},
      "section": {"radius": "6 mm"}, "material": {"density": 5200, "youngs_modulus": "8 GPa"},
      "elements": {"count": 8}}],
    "supports": [{"beam": "cable", "at": "start", "type": "pinned", "name": "A"},
                 {"beam": "cable", "at": "end", "type": "pinned"}],
    "output": {"probes": [{"name": "mid", "beam": "cable", "at": {"fraction": 0.4}}]},
    "analysis": {"type": "static"}})json",
                 R"json("variables": [
      {"name": "z1", "control_point": {"beam": "cable", "index": 1, "axis": "z"}, "range": [-0.3, -0.1]},
      {"name": "x2", "control_point": {"beam": "cable", "index": 2, "axis": "x"}, "range": [2.8, 3.2]},
      {"name": "w3", "weight": {"beam": "cable", "index": 3}, "range": [0.9, 1.2]},
      {"name": "density", "path": "beams[0].material.density", "range": [5000, 5400]}],
    "quantities": [{"name": "force", "value": "at(end, mid.axial_force)"},
      {"name": "greatest", "value": "at(end, cable.axial_force.max)"},
      {"name": "stress", "value": "at(end, mid.axial_force) / 1e-4 + at(end, mid.moment)"},
      {"name": "energy", "value": "at(end, energy.axial)"}, {"name": "reaction", "value": "at(end, A.fx)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.02, 1e-6);
}

// The elements on both sides of a knot carry an axial force of their own. Where a probe is at the knot, which
// moves, runs on one side of the nominal one look at the element that this looks at: differences towards
// there, whose error is of first order.
TEST(Gradient, OfASectionAtAKnotIsThatOfTheElementThatTheRunLooksAt) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.5, 1, 1, 1, 1],
                         "control_points": [[0, 0, 0], [0.8, 0, 0.35], [1.5, 0, 0.5], [2.2, 0, 0.35], [3, 0, 0]]}},
      "section": {"radius": "20 mm"}, "material": {"density": 2700, "youngs_modulus": "2 GPa"},
      "elements": {"count": 4}}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped"}],
    "output": {"probes": [{"name": "mid", "beam": "beam", "at": {"fraction": 0.5}}]},
    "analysis": {"type": "static"}})json",
                 R"json("variables": [
      {"name": "x2", "control_point": {"beam": "beam", "index": 2, "axis": "x"}, "range": [1, 2]}],
    "quantities": [{"name": "axial force", "value": "at(end, mid.axial_force)"},
                   {"name": "moment", "value": "at(end, mid.moment)"},
                   {"name": "shear force", "value": "at(end, mid.shear_force)"},
                   {"name": "displacement", "value": "at(end, mid.uz)"}],
    "plan": {"gradient": "nominal"})json");
  const Variant at_knot = of.run({1.5}, true);
  const auto change = [&](double h, std::size_t quantity) {
    return of.run({1.5 + h}, false).quantities[quantity] - at_knot.quantities[quantity];
  };
  constexpr double step = 4e-3;
  const double same_side = std::abs(change(step, 0)) < std::abs(change(-step, 0)) ? step : -step;
  ASSERT_GT(std::abs(change(-same_side, 0)), 100 * std::abs(change(same_side, 0))) << "the force jumps";
  for (std::size_t i = 0; i < at_knot.quantities.size(); ++i) {
    const double g = at_knot.gradient[i][0], coarse = change(same_side, i) / same_side,
                 fine = change(same_side / 2, i) / (same_side / 2);
    EXPECT_NEAR(g, 2 * fine - coarse, 1e-3 * std::abs(g)) << i;
    EXPECT_NEAR((coarse - g) / (fine - g), 2, 0.1) << i << ": the rate";
  }
}

}  // namespace
}  // namespace nurbeam
