#include "pipelines/study/gradient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "pipelines/model/model_snapshot.h"
#include "pipelines/run/simulation_plan.h"
#include "pipelines/study/analysis.h"
#include "pipelines/study/variant.h"
#include "tests/study/study_text.h"

namespace nurbeam {
namespace {

using test::TemporaryDirectory;

/// A study of a case, whose variants come with derivatives.
struct StudyOfCase {
  TemporaryDirectory directory = {};
  StudyFile study;
  StudyCase study_case;

  StudyOfCase(const std::string& case_text, const std::string& rest)
      : study(read(case_text, rest)), study_case(read_case()) {}

  Variant run(const std::vector<double>& free, bool derivatives) {
    study.derivatives = derivatives;
    Variant variant = run_variant(study, &study_case, 0, all_values(study, free));
    EXPECT_EQ(variant.status, VariantStatus::done) << variant.reason;
    return variant;
  }
  std::vector<double> nominal() const {
    std::vector<double> values;
    for (const std::size_t i : study.free_variables()) values.push_back(study.variables[i].nominal);
    return values;
  }

 private:
  StudyFile read(const std::string& case_text, const std::string& rest) {
    directory.write("case.json", case_text);
    StudyFileReport report = read_study_file(
        directory.write("study.json", R"json({"nurbeam_study": 1, "case": "case.json", )json" + rest + "}"));
    for (const Diagnostic& d : report.diagnostics) ADD_FAILURE() << d.where << ": " << d.message;
    return std::move(*report.value);
  }
  StudyCase read_case() const {
    StudyCaseReport report = read_study_case(study);
    for (const Diagnostic& d : report.diagnostics) ADD_FAILURE() << d.where << ": " << d.message;
    return std::move(*report.value);
  }
};

/// Holds every derivative to central differences of whole runs, whose error falls with the square of their
/// step: a part of the range. What a run decides, as after which step the mesh changes, must be the same for
/// the differences.
void expect_gradient(StudyOfCase& of, double step, double accuracy) {
  const std::vector<double> nominal = of.nominal();
  const Variant variant = of.run(nominal, true);
  const std::vector<std::size_t> free = of.study.free_variables();
  ASSERT_EQ(variant.gradient.size(), of.study.quantities.size());
  std::vector<std::vector<double>> differences[2];
  for (int halved = 0; halved < 2; ++halved)
    for (std::size_t k = 0; k < free.size(); ++k) {
      const std::vector<double>& range = of.study.variables[free[k]].distribution.parameters;
      const double h = step * (range.back() - range.front()) / (halved ? 2 : 1);
      std::vector<double> more = nominal, less = nominal, column;
      more[k] += h;
      less[k] -= h;
      const Variant above = of.run(more, false), below = of.run(less, false);
      ASSERT_FALSE(above.quantities.empty() || below.quantities.empty());
      for (std::size_t i = 0; i < of.study.quantities.size(); ++i)
        column.push_back((above.quantities[i] - below.quantities[i]) / (2 * h));
      differences[halved].push_back(column);
    }
  for (std::size_t i = 0; i < of.study.quantities.size(); ++i) {
    for (std::size_t k = 0; k < free.size(); ++k) {
      const double g = variant.gradient[i][k], coarse = differences[0][k][i], fine = differences[1][k][i];
      const double limit = (4 * fine - coarse) / 3;
      // Of the derivative, or of a hundredth of the quantity over the range where others cancel in it.
      const std::vector<double>& range = of.study.variables[free[k]].distribution.parameters;
      const double tolerance = accuracy * std::max(std::abs(g), 0.01 * std::abs(variant.quantities[i]) /
                                                                    (range.back() - range.front()));
      const std::string where = of.study.quantities[i].name + " by " + of.study.variables[free[k]].name;
      EXPECT_NEAR(g, limit, tolerance) << where << ": differences " << coarse << ", " << fine;
      if (std::abs(fine - g) > 3 * tolerance)
        EXPECT_NEAR((coarse - g) / (fine - g), 4, 0.4) << where << ": the rate";
    }
  }
}

const std::string plane_beam = R"json("beams": [{"name": "beam",
    "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1], "weights": [1, 0.9, 1.1, 1],
                       "control_points": [[0, 0, 0], [1, 0, 0.4], [2, 0, 0.3], [3, 0, 0]]}},
    "section": {"radius": "20 mm"}, "material": {"density": 2700, "youngs_modulus": "2 GPa"},
    "elements": {"count": 8}}])json";

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

/// A cantilever whose axis is a cubic B-spline in even spans: each control point reaches four of them.
std::string spline_case(int points, int elements, const std::string& analysis) {
  std::ostringstream knots, control;
  for (int k = 0; k < points + 4; ++k)
    knots << (k > 0 ? ", " : "") << std::clamp(k - 3, 0, points - 3) / (points - 3.0);
  for (int i = 0; i < points; ++i) {
    const double x = 3.0 * i / (points - 1);
    control << (i > 0 ? ", [" : "[") << x << ", 0, " << 0.4 * std::sin(1.3 * x) << "]";
  }
  return R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "beam",
    "axis": {"nurbs": {"degree": 3, "knots": [)json" +
         knots.str() + R"json(], "control_points": [)json" + control.str() + R"json(]}},
    "section": {"radius": "20 mm"}, "material": {"density": 2700, "youngs_modulus": "2 GPa"},
    "elements": {"count": )json" +
         std::to_string(elements) + R"json(}}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"}],
    "output": {"every": 0.02, "probes": [{"name": "tip", "beam": "beam", "at": "end"}]}, "analysis": )json" +
         analysis + "}";
}
constexpr const char* short_motion = R"json({"type": "dynamic", "end_time": 0.04, "step": "2 ms"})json";

TEST(Gradient, ByControlPointsThatReachOnlySomeElements) {
  const std::string study = R"json("variables": [
      {"name": "z3", "control_point": {"beam": "beam", "index": 3, "axis": "z"}, "range": [0.2, 0.6]},
      {"name": "x8", "control_point": {"beam": "beam", "index": 8, "axis": "x"}, "range": [1.7, 2.1]},
      {"name": "density", "path": "beams[0].material.density", "range": [2600, 2800]}],
    "quantities": [{"name": "z", "value": "at(end, tip.z)"}, {"name": "m", "value": "at(end, root.my)"}],
    "plan": {"grid": 2})json";
  StudyOfCase motion(spline_case(13, 40, short_motion), study);
  expect_gradient(motion, 0.004, 1e-5);
  StudyOfCase rest(spline_case(13, 40, R"json({"type": "static"})json"), study);
  expect_gradient(rest, 0.004, 1e-6);
}

// What a run of as many steps takes three or four times: a matrix is taken in each step, and the residuals of
// few of the elements.
TEST(Gradient, ByTwentyControlPointsTakesFewEvaluations) {
  std::ostringstream variables;
  for (int i = 2; i < 22; ++i)
    variables << (i > 2 ? ", " : "") << R"json({"name": "z)json" << i
              << R"json(", "control_point": {"beam": "beam", "axis": "z", "index": )json" << i
              << R"json(}, "range": [-1, 1]})json";
  const StudyOfCase of(spline_case(22, 80, short_motion), "\"variables\": [" + variables.str() + R"json(],
    "quantities": [{"name": "z", "value": "at(end, tip.z)"}], "plan": {"gradient": "nominal"})json");
  const std::vector<double> values = all_values(of.study, of.nominal());
  const CaseFileReport read =
      read_case_text(of.study_case.variant(of.study.variables, values), of.study_case.file());
  const BuildReport built = build_model(*read.value);
  const SimulationOptions options = simulation_options(*read.value);
  VariantGradient gradient(of.study, of.study_case, values, *read.value, *built.value);
  SimulationObserver observer;
  observer.follower = &gradient.follower();
  const SimulationReport run = simulate(built.value->model, probe_places(*built.value), options, observer);
  ASSERT_EQ(run.steps, 20);
  const Sensitivities::Work& work = dynamic_cast<const Sensitivities&>(gradient.follower()).work();
  EXPECT_EQ(work.tangents, run.steps);
  EXPECT_EQ(work.solves, 20 * run.steps);
  EXPECT_LT(work.residuals, 0.4 * (2 * 20 * run.steps));
  EXPECT_GT(work.residuals, 0.1 * (2 * 20 * run.steps));
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

const std::string plane_slide = R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1], "weights": [1, 0.9, 1.1, 1],
                         "control_points": [[0, 0, 0], [1, 0, -0.4], [2, 0, -0.7], [3, 0, -1.2]]}},
      "section": {"radius": "20 mm"}, "material": {"density": 2700, "youngs_modulus": "2 GPa"},
      "elements": {"count": 8}}],
    "bodies": [{"name": "slider", "mass": 1.2}],
    "sliding_joints": [{"body": "slider", "beam": "beam", "at": {"length": 0.9}, "speed": 1}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"},
                 {"beam": "beam", "at": "end", "type": "pinned"}], )json";
const std::string slide_study = R"json("variables": [
      {"name": "z2", "control_point": {"beam": "beam", "index": 2, "axis": "z"}, "range": [-0.9, -0.5]},
      {"name": "w1", "weight": {"beam": "beam", "index": 1}, "range": [0.6, 1.2]},
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]},
      {"name": "radius", "path": "beams[0].section.radius", "range": [0.015, 0.025]},
      {"name": "mass", "path": "bodies[0].mass", "range": [1, 2]},
      {"name": "place", "path": "sliding_joints[0].at.length", "range": [0.8, 1], "nominal": 0.9},
      {"name": "speed", "path": "sliding_joints[0].speed", "range": [0, 2], "nominal": 1}], )json";

TEST(Gradient, OfASlidingBodyBeforeAnyEvent) {
  StudyOfCase of(plane_slide + R"json("analysis": {"type": "dynamic", "end_time": 0.03, "step": "1 ms"},
    "output": {"every": 0.01}})json",
                 slide_study + R"json(
    "quantities": [{"name": "s", "value": "at(end, slider.s)"}, {"name": "v", "value": "max(slider.speed)"},
      {"name": "z", "value": "at(end, slider.z)"}],
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

const std::string space_beam = R"json("gravity": [0, 0, -9.81], "beams": [{"name": "beam",
    "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1], "weights": [1, 0.9, 1.1, 1],
                       "control_points": [[0, 0, 0], [0.7, 0.1, 0], [1, 0.8, 0.1], [0.9, 1.5, 0.3]]}},
    "section": {"rectangle": [0.04, 0.02]}, "orientation": {"up": [0, 0, 1]},
    "material": {"density": 2700, "youngs_modulus": "2 GPa", "poissons_ratio": 0.3},
    "elements": {"count": 4}}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"}], )json";
const std::string space_study = R"json("variables": [
      {"name": "y2", "control_point": {"beam": "beam", "index": 2, "axis": "y"}, "range": [0.7, 0.9]},
      {"name": "x1", "control_point": {"beam": "beam", "index": 1, "axis": "x"}, "range": [0.6, 0.8]},
      {"name": "w2", "weight": {"beam": "beam", "index": 2}, "range": [0.9, 1.3]},
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]},
      {"name": "height", "path": "beams[0].section.rectangle[1]", "range": [0.015, 0.025]},
      {"name": "density", "path": "beams[0].material.density", "range": [2600, 2800]}], )json";

TEST(Gradient, OfABeamInSpaceWithTorsionAtRest) {
  StudyOfCase of(R"json({"nurbeam": 1, )json" + space_beam + R"json("analysis": {"type": "static"},
    "output": {"probes": [{"name": "tip", "beam": "beam", "at": "end"}]}})json",
                 space_study + R"json("quantities": [{"name": "sag", "value": "at(end, tip.uz)"},
      {"name": "aside", "value": "at(end, tip.ux)"}, {"name": "torque", "value": "at(end, root.mx)"}],
    "plan": {"grid": 2})json");
  expect_gradient(of, 0.01, 1e-6);
}

/// Whether one variant's derivatives come by adjoints of its rests.
bool is_by_adjoint(const StudyOfCase& of) {
  const std::vector<double> values = all_values(of.study, of.nominal());
  const CaseFileReport read =
      read_case_text(of.study_case.variant(of.study.variables, values), of.study_case.file());
  const BuildReport built = build_model(*read.value);
  return VariantGradient(of.study, of.study_case, values, *read.value, *built.value).is_by_adjoint();
}

// The direct solutions of as many parameters are the witness: taken where there are as many quantities.
TEST(Gradient, IsTheSameByTheAdjointOfARestAsBySolutionsForEachParameter) {
  const std::string hanging = R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1], "weights": [1, 0.9, 1.1, 1],
                         "control_points": [[0, 0, 0], [1, 0, -0.4], [2, 0, -0.7], [3, 0, -0.2]]}},
      "section": {"radius": "20 mm"}, "material": {"density": 2700, "youngs_modulus": "2 GPa"},
      "elements": {"count": 8}}],
    "bodies": [{"name": "slider", "mass": 1.2}],
    "sliding_joints": [{"body": "slider", "beam": "beam", "at": {"length": 0.9}, "equilibrium": )json";
  const std::string rest = R"json(}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"},
                 {"beam": "beam", "at": "end", "type": "pinned", "name": "far"}],
    "analysis": {"type": "static"}})json";
  const std::string by = R"json("variables": [
      {"name": "z2", "control_point": {"beam": "beam", "index": 2, "axis": "z"}, "range": [-0.9, -0.5]},
      {"name": "w1", "weight": {"beam": "beam", "index": 1}, "range": [0.6, 1.2]},
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]},
      {"name": "radius", "path": "beams[0].section.radius", "range": [0.015, 0.025]},
      {"name": "mass", "path": "bodies[0].mass", "range": [1, 2]}], "plan": {"grid": 2}, "quantities": [)json";
  const std::string some = R"json({"name": "z", "value": "at(end, slider.z) * mass"},
      {"name": "s", "value": "at(end, slider.s)"}, {"name": "m", "value": "at(end, root.my)"},
      {"name": "f", "value": "at(end, far.fx) + sqrt(E)"})json";
  const std::string more = R"json(, {"name": "again", "value": "at(end, slider.z)"}])json";
  for (const std::string where : {"\"held\"", "\"free\""}) {
    StudyOfCase one(hanging + where + rest, by + some + "]"), other(hanging + where + rest, by + some + more);
    EXPECT_TRUE(is_by_adjoint(one));
    EXPECT_FALSE(is_by_adjoint(other));
    const Variant by_adjoint = one.run(one.nominal(), true);
    const StudyGradient direct = other.run(other.nominal(), true).gradient;
    for (std::size_t i = 0; i < by_adjoint.gradient.size(); ++i)
      for (std::size_t k = 0; k < by_adjoint.gradient[i].size(); ++k) {
        const std::vector<double>& range = one.study.variables[k].distribution.parameters;
        // Of the derivative, or of a hundredth of the quantity over the range where it is zero.
        const double size = std::max(std::abs(direct[i][k]), 0.01 * std::abs(by_adjoint.quantities[i]) /
                                                                 (range.back() - range.front()));
        EXPECT_NEAR(by_adjoint.gradient[i][k], direct[i][k], 1e-7 * size) << i << " by " << k;
      }
  }
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

TEST(Gradient, OfFormulasIsThatOfTheirExpressions) {
  const StudyFile study = test::study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "x", "range": [1, 3]}, {"name": "y", "range": [0, 1]}, {"name": "z", "value": "x * y"}],
    "quantities": [{"name": "f", "value": "x^2 * exp(y) + sin(z)"}], "plan": {"gradient": [[2, 0.5], [1.5, 0.1]]}})json");
  ASSERT_TRUE(study.derivatives);
  for (const std::vector<double>& point : std::get<StudyPlan>(study.task).rows) {
    const Variant variant = run_variant(study, nullptr, 0, all_values(study, point));
    const double x = point[0], y = point[1];
    EXPECT_NEAR(variant.gradient[0][0], 2 * x * std::exp(y) + y * std::cos(x * y), 1e-7);
    EXPECT_NEAR(variant.gradient[0][1], x * x * std::exp(y) + x * std::cos(x * y), 1e-7);
  }
}

/// A study of formulas that counts its variants, with and without their derivatives.
struct CountedStudy {
  StudyFile study;
  int variants = 0;

  explicit CountedStudy(const std::string& text) : study(test::study_of(text)) {}

  StudyEvaluation evaluation() {
    return [this](const StudyPoints& points) {
      StudyPoints quantities;
      for (const std::vector<double>& point : points)
        quantities.push_back(run_variant(study, nullptr, 0, all_values(study, point)).quantities);
      variants += static_cast<int>(points.size());
      return quantities;
    };
  }
  StudyDerivatives derivatives() const {
    return [this](const std::vector<double>& point) {
      return run_variant(study, nullptr, 0, all_values(study, point)).gradient;
    };
  }
};

TEST(Gradient, TakesFormToTheIndexOfALinearLimitInFewVariants) {
  CountedStudy of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "R", "distribution": {"normal": {"mean": 10, "sd": 1.5}}},
                  {"name": "S", "distribution": {"normal": {"mean": 5, "sd": 2}}}],
    "quantities": [{"name": "margin", "value": "R - S"}], "reliability": {"quantity": "margin", "below": 0}})json");
  ASSERT_TRUE(of.study.derivatives);
  const auto& task = std::get<StudyReliability>(of.study.task);
  const ReliabilityResult result = failure_probability(of.study, task, of.evaluation(), of.derivatives());
  EXPECT_NEAR(*result.reliability_index, 2, 1e-6);
  const int along = std::exchange(of.variants, 0);
  failure_probability(of.study, task, of.evaluation());
  EXPECT_LT(2 * along, of.variants);
}

// Rosenbrock's valley, cut off by a constraint on the way: x^2 + y^2 <= 1 holds at the best with equality.
TEST(Gradient, LeadsASearchAlongItsConstraints) {
  CountedStudy of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "x", "range": [-2, 2], "nominal": -1}, {"name": "y", "range": [-1, 3], "nominal": 0.2}],
    "quantities": [{"name": "f", "value": "(1 - x)^2 + 100 * (y - x^2)^2"}, {"name": "r", "value": "x^2 + y^2"}],
    "optimise": {"minimise": "f", "subject_to": ["r <= 1"], "method": "gradient", "evaluations": 200,
                 "tolerance": 1e-8}})json");
  const auto& task = std::get<StudyOptimum>(of.study.task);
  const OptimumResult result = find_optimum(of.study, task, of.evaluation(), of.derivatives());
  EXPECT_NEAR(result.points[0][0], 0.786415, 1e-4);  // of Lagrange's equations
  EXPECT_NEAR(result.points[0][1], 0.617698, 1e-4);
  const int along = std::exchange(of.variants, 0);
  find_optimum(of.study, task, of.evaluation());
  EXPECT_LT(2 * along, of.variants);
}

TEST(Gradient, IsRefusedWhereThereIsNone) {
  const auto refused = [](const std::string& of_case, const std::string& of_study) {
    StudyOfCase of(of_case, of_study + R"json(, "quantities": [{"name": "s", "value": "at(end, slider.s)"}],
      "plan": {"gradient": "nominal"})json");
    std::string all;
    for (const Diagnostic& d : check_quantities(of.study, &of.study_case)) all += d.message + "\n";
    return all;
  };
  const std::string mass =
      R"json("variables": [{"name": "m", "path": "bodies[0].mass", "range": [1, 2]}])json";
  const auto slide = [](const std::string& analysis) {
    return plane_slide + "\"analysis\": {" + analysis + "}}";
  };
  EXPECT_EQ(refused(slide(R"json("type": "dynamic", "end_time": 0.1, "step": 0.01)json"), mass), "");
  EXPECT_NE(
      refused(slide(R"json("type": "dynamic", "end_time": 0.1, "integrator": {"type": "ida"})json"), mass)
          .find("generalized-alpha"),
      std::string::npos);
  EXPECT_NE(
      refused(slide(R"json("type": "dynamic", "end_time": 0.1, "step": 0.01)json"),
              R"json("variables": [{"name": "end", "path": "analysis.end_time", "range": [0.1, 0.2]}])json")
          .find("no derivative by \"end\": variables that change the times of a run"),
      std::string::npos);
  std::string rough = slide(R"json("type": "dynamic", "end_time": 0.1, "step": 0.01)json");
  rough.replace(rough.find("\"speed\": 1"), 10, R"json("friction": {"coefficient": 0.1})json");
  EXPECT_NE(refused(rough, mass).find("friction"), std::string::npos);
}

}  // namespace
}  // namespace nurbeam
