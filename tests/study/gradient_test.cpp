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
  expect_gradient(of, 0.02, 1e-6);
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
  expect_gradient(of, 0.02, 1e-5);
}

}  // namespace
}  // namespace nurbeam
