#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/study/variant.h"
#include "tests/study/study_text.h"

/// Studies of cases whose variants come with derivatives.
namespace nurbeam::test {

/// The case with steps that do not settle, as derivatives are those of such steps.
inline std::string unsettled(const std::string& text) {
  nlohmann::json json = nlohmann::json::parse(text, nullptr, true, true);
  nlohmann::json& analysis = json["analysis"];
  const bool other = analysis.contains("integrator") &&
                     analysis["integrator"].value("type", "generalized-alpha") != "generalized-alpha";
  if (analysis.value("type", "dynamic") == "dynamic" && !other) analysis["integrator"]["settle"] = false;
  return json.dump();
}

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
    directory.write("case.json", unsettled(case_text));
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
inline void expect_gradient(StudyOfCase& of, double step, double accuracy) {
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

inline const std::string plane_beam = R"json("beams": [{"name": "beam",
    "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1], "weights": [1, 0.9, 1.1, 1],
                       "control_points": [[0, 0, 0], [1, 0, 0.4], [2, 0, 0.3], [3, 0, 0]]}},
    "section": {"radius": "20 mm"}, "material": {"density": 2700, "youngs_modulus": "2 GPa"},
    "elements": {"count": 8}}])json";

/// A cantilever whose axis is a cubic B-spline in even spans: each control point reaches four of them.
inline std::string spline_case(int points, int elements, const std::string& analysis) {
  std::ostringstream knots, control;
  for (int k = 0; k < points + 4; ++k)
    knots << (k > 0 ? ", " : "") << std::clamp(k - 3, 0, points - 3) / (points - 3.0);
  for (int i = 0; i < points; ++i) {
    const double x = 3.0 * i / (points - 1);
    control << (i > 0 ? ", [" : "[") << x << ", 0, " << 0.4 * std::sin(1.3 * x) << "]";
  }
  const char* every = analysis.find("static") == std::string::npos ? R"json("every": 0.02, )json" : "";
  return R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "beam",
    "axis": {"nurbs": {"degree": 3, "knots": [)json" +
         knots.str() + R"json(], "control_points": [)json" + control.str() + R"json(]}},
    "section": {"radius": "20 mm"}, "material": {"density": 2700, "youngs_modulus": "2 GPa"},
    "elements": {"count": )json" +
         std::to_string(elements) + R"json(}}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"}],
    "output": {)json" +
         every + R"json("probes": [{"name": "tip", "beam": "beam", "at": "end"}]}, "analysis": )json" +
         analysis + "}";
}
inline const std::string plane_slide = R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1], "weights": [1, 0.9, 1.1, 1],
                         "control_points": [[0, 0, 0], [1, 0, -0.4], [2, 0, -0.7], [3, 0, -1.2]]}},
      "section": {"radius": "20 mm"}, "material": {"density": 2700, "youngs_modulus": "2 GPa"},
      "elements": {"count": 8}}],
    "bodies": [{"name": "slider", "mass": 1.2}],
    "sliding_joints": [{"body": "slider", "beam": "beam", "at": {"length": 0.9}, "speed": 1}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"},
                 {"beam": "beam", "at": "end", "type": "pinned"}], )json";
inline const std::string slide_study = R"json("variables": [
      {"name": "z2", "control_point": {"beam": "beam", "index": 2, "axis": "z"}, "range": [-0.9, -0.5]},
      {"name": "w1", "weight": {"beam": "beam", "index": 1}, "range": [0.6, 1.2]},
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]},
      {"name": "radius", "path": "beams[0].section.radius", "range": [0.015, 0.025]},
      {"name": "mass", "path": "bodies[0].mass", "range": [1, 2]},
      {"name": "place", "path": "sliding_joints[0].at.length", "range": [0.8, 1], "nominal": 0.9},
      {"name": "speed", "path": "sliding_joints[0].speed", "range": [0, 2], "nominal": 1}], )json";

inline const std::string space_beam = R"json("gravity": [0, 0, -9.81], "beams": [{"name": "beam",
    "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1], "weights": [1, 0.9, 1.1, 1],
                       "control_points": [[0, 0, 0], [0.7, 0.1, 0], [1, 0.8, 0.1], [0.9, 1.5, 0.3]]}},
    "section": {"rectangle": [0.04, 0.02]}, "orientation": {"up": [0, 0, 1]},
    "material": {"density": 2700, "youngs_modulus": "2 GPa", "poissons_ratio": 0.3},
    "elements": {"count": 4}}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped", "name": "root"}], )json";
inline const std::string space_study = R"json("variables": [
      {"name": "y2", "control_point": {"beam": "beam", "index": 2, "axis": "y"}, "range": [0.7, 0.9]},
      {"name": "x1", "control_point": {"beam": "beam", "index": 1, "axis": "x"}, "range": [0.6, 0.8]},
      {"name": "w2", "weight": {"beam": "beam", "index": 2}, "range": [0.9, 1.3]},
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]},
      {"name": "height", "path": "beams[0].section.rectangle[1]", "range": [0.015, 0.025]},
      {"name": "density", "path": "beams[0].material.density", "range": [2600, 2800]}], )json";

/// A rail in space with torsion, of seven spans with two elements in each, over which a body slides through
/// changes of the mesh.
inline std::string rail_case(const char* section) {
  return R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "rail",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.14, 0.28, 0.42, 0.56, 0.7, 0.84, 1, 1, 1, 1],
                         "control_points": [[0, 0, 1], [0.35, 0.1, 0.8], [0.7, 0.25, 0.6], [1.1, 0.3, 0.45], [1.5, 0.2, 0.35],
                                            [1.9, 0, 0.25], [2.3, -0.15, 0.2], [2.7, -0.2, 0.2], [3.1, -0.1, 0.25], [3.5, 0.1, 0.3]]}},
      "section": )json" +
         std::string(section) + R"json(,
      "material": {"density": 2700, "youngs_modulus": "30 GPa", "shear_modulus": "12 GPa"},
      "torsion": true, "elements": {"count": 14}}],
    "bodies": [{"name": "a", "mass": 1.3}],
    "sliding_joints": [{"body": "a", "beam": "rail", "at": {"length": 0.7}, "speed": 3}],
    "supports": [{"beam": "rail", "at": "start", "type": "clamped"}, {"beam": "rail", "at": "end", "type": "clamped"}],
    "analysis": {"type": "dynamic", "end_time": 0.3, "step": "1 ms"}, "output": {"every": 0.05}})json";
}

/// Control points that the body leaves, comes to and never sees.
inline const std::string rail_study = R"json("variables": [
      {"name": "z1", "control_point": {"beam": "rail", "index": 1, "axis": "z"}, "range": [0.75, 0.85]},
      {"name": "y3", "control_point": {"beam": "rail", "index": 3, "axis": "y"}, "range": [0.25, 0.35]},
      {"name": "z5", "control_point": {"beam": "rail", "index": 5, "axis": "z"}, "range": [-0.15, 0.65]},
      {"name": "y8", "control_point": {"beam": "rail", "index": 8, "axis": "y"}, "range": [-0.5, 0.3]}],
    "quantities": [{"name": "s", "value": "at(end, a.s)"}, {"name": "v", "value": "at(end, a.speed)"},
      {"name": "y", "value": "at(0.2, a.y)"}],
    "plan": {"grid": 2})json";

}  // namespace nurbeam::test
