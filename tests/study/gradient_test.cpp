#include "pipelines/study/gradient.h"

#include <gtest/gtest.h>

#include <cmath>

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
/// step. `steps`: of each variable, as parts of its range.
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
      const double tolerance = accuracy * std::abs(g);
      const std::string where = of.study.quantities[i].name + " by " + of.study.variables[free[k]].name;
      EXPECT_NEAR(g, limit, tolerance) << where << ": differences " << coarse << ", " << fine;
      if (std::abs(fine - g) > 3 * tolerance)
        EXPECT_NEAR((coarse - g) / (fine - g), 4, 0.4) << where << ": the rate";
      std::printf("%-40s %15.8e  limit off by %.1e, rate %.2f, fd off by %.1e\n", where.c_str(), g,
                  limit / g - 1, (coarse - g) / (fine - g), fine / g - 1);
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
  expect_gradient(of, 0.01, 1e-4);
}

}  // namespace
}  // namespace nurbeam
