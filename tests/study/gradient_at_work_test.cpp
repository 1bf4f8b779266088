#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "pipelines/study/analysis.h"
#include "tests/study/study_of_case.h"

namespace nurbeam {
namespace {

using test::plane_slide;
using test::StudyOfCase;

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
      refused(slide(R"json("type": "dynamic", "end_time": 0.1, "integrator": {"type": "radau"})json"), mass)
          .find("generalized-alpha"),
      std::string::npos);
  EXPECT_NE(
      refused(slide(R"json("type": "dynamic", "end_time": 0.1, "step": 0.01)json"),
              R"json("variables": [{"name": "end", "path": "analysis.end_time", "range": [0.1, 0.2]}])json")
          .find("no derivative by \"end\": variables that change the times of a run"),
      std::string::npos);
  std::string rough = slide(R"json("type": "dynamic", "end_time": 0.1, "step": 0.01)json");
  rough.replace(rough.find("\"speed\": 1"), 10, R"json("friction": {"coefficient": 0.1})json");
  EXPECT_EQ(
      refused(rough, mass),
      "there is no derivative here with the friction of \"slider\" on beam \"beam\"; leave it out, or take "
      "differences of runs\n");
  std::string stopped = slide(R"json("type": "dynamic", "end_time": 0.1, "step": 0.01)json");
  stopped.insert(1, R"json("stops": [{"beam": "beam", "at": {"length": 2}}], )json");
  EXPECT_NE(refused(stopped, mass).find("with a stop of \"slider\" on beam \"beam\""), std::string::npos)
      << refused(stopped, mass);
}

// What is said of a variant that has no derivatives.
std::string told_of(const std::string& of_case, const std::string& variables, const std::string& quantity) {
  StudyOfCase of(of_case, variables + R"json(, "quantities": [{"name": "q", "value": ")json" + quantity +
                              R"json("}], "plan": {"gradient": "nominal"})json");
  std::string all;
  for (const Diagnostic& d : check_quantities(of.study, &of.study_case)) all += d.message + "\n";
  return all + run_variant(of.study, &of.study_case, 0, all_values(of.study, of.nominal())).reason;
}

// The torque's shear stress comes from a mesh of the section, which just there becomes another one; stiffness
// in torsion is more exact, and a round section has its stress in closed form.
TEST(Gradient, SaysThatStressesOfMeshedSectionsHaveNone) {
  const auto of = [](const char* section, const char* path, const char* quantity) {
    return told_of(
        std::string(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1],
        "control_points": [[0, 0, 0], [0.7, 0.1, 0], [1, 0.8, 0.1], [0.9, 1.5, 0.3]]}},
      "orientation": {"up": [0, 0, 1]}, "section": )json") +
            section +
            R"json(, "material": {"density": 2700, "youngs_modulus": "7 GPa", "poissons_ratio": 0.3},
      "elements": {"count": 4}}],
      "supports": [{"beam": "beam", "at": "start", "type": "clamped"}],
      "analysis": {"type": "static"}, "output": {"probes": [{"name": "P", "beam": "beam", "at": {"fraction": 0.1}}]}})json",
        std::string(R"json("variables": [{"name": "h", "path": "beams[0].section.)json") + path +
            R"json(", "range": [0.009, 0.041], "nominal": 0.0171}])json",
        quantity);
  };
  const char *rectangle = R"json({"rectangle": [0.04, 0.0171]})json",
             *round = R"json({"radius": 0.0171})json";
  const std::string told = of(rectangle, "rectangle[1]", "at(end, P.von_mises)");
  EXPECT_NE(
      told.find(
          "no derivative by \"h\": the shear stress of the section of beam \"beam\" is found on a mesh"),
      std::string::npos)
      << told;
  EXPECT_EQ(of(rectangle, "rectangle[1]", "at(end, P.z)"), "");
  EXPECT_EQ(of(round, "radius", "at(end, P.von_mises)"), "");
}

TEST(Gradient, SaysWhyThereAreNoNeighbours) {
  const std::string told = told_of(test::spline_case(6, 4, R"json({"type": "static"})json"),
                                   R"json("variables": [{"name": "x", "range": [0, 1]},
                           {"name": "n", "path": "beams[0].elements.count", "value": "4 + 2 * x"}])json",
                                   "at(end, tip.z)");
  for (const char* part :
       {"no derivative by \"x\": with a little more and with a little less of it there is no model: ",
        "beams[0].elements.count: is ",
        "; expected an integer; take another \"nominal\" value, or a method without derivatives"})
    EXPECT_NE(told.find(part), std::string::npos) << part << "\n" << told;
}

TEST(Gradient, SaysWhatIsNotAlikeInNeighbours) {
  const std::string plane_case = test::spline_case(6, 4, R"json({"type": "static"})json");
  const std::string out_of_plane = told_of(
      plane_case,
      R"json("variables": [{"name": "y", "control_point": {"beam": "beam", "index": 2, "axis": "y"}, "range": [-1, 1]}])json",
      "at(end, tip.z)");
  EXPECT_NE(
      out_of_plane.find("no derivative by \"y\": the model is plane, and one in space with another value"),
      std::string::npos)
      << out_of_plane;
  // With so narrow a range neighbours are in space by less than round-off may be.
  std::string loaded = plane_case;
  loaded.insert(1, R"json("loads": [{"beam": "beam", "at": "end", "force": [-17, 0, -16]}], )json");
  const std::string turned = told_of(
      loaded, R"json("variables": [{"name": "fy", "path": "loads[0].force[1]", "range": [-1e-3, 1e-3]}])json",
      "at(end, tip.y)");
  EXPECT_NE(turned.find("no derivative by \"fy\": the model is plane, and one in space with another value"),
            std::string::npos)
      << turned;

  for (const auto& [setting, range] :
       {std::pair{"integrator.rho_infinity", R"json("range": [0.5, 0.9], "nominal": 0.6)json"},
        {"step", R"json("range": [0.005, 0.009], "nominal": 0.006)json"}}) {
    const std::string other = told_of(
        test::spline_case(
            6, 4, R"json({"end_time": 0.01, "step": 0.006, "integrator": {"rho_infinity": 0.6}})json"),
        std::string(R"json("variables": [{"name": "v", "path": "analysis.)json") + setting +
            R"json(", )json" + range + "}]",
        "at(end, tip.z)");
    EXPECT_NE(
        other.find("no derivative by \"v\": variables that change the times of a run, its integrator or "
                   "when its mesh changes have no derivative"),
        std::string::npos)
        << setting << ": " << other;
  }

  // A parabola that turns by more than a right angle is one cubic, or two where it is rational.
  const auto guide = [](const char* weight) {
    return told_of(
        std::string(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "rail", "rigid": true,
        "axis": {"nurbs": {"degree": 2, "knots": [0, 0, 0, 1, 1, 1], "control_points": [[0, 0, 0], [1, 0, -3], [2, 0, 0]],
                           "weights": [1, )json") +
            weight + R"json(, 1]}}}],
      "bodies": [{"name": "car", "mass": 2}],
      "sliding_joints": [{"body": "car", "beam": "rail", "at": {"length": 0.5}}],
      "analysis": {"end_time": 0.1, "step": 0.01}})json",
        std::string(
            R"json("variables": [{"name": "w", "weight": {"beam": "rail", "index": 1}, "range": [0.5, 1.5], "nominal": )json") +
            weight + "}]",
        "at(end, car.z)");
  };
  // A quarter circle is one cubic, and so is what turns by a little more.
  EXPECT_EQ(told_of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "b",
        "axis": {"nurbs": {"degree": 2, "knots": [0, 0, 0, 1, 1, 1], "control_points": [[0, 0, 0], [1, 0, 0], [1, 0, 1]],
                           "weights": [1, 0.7071067811865476, 1]}},
        "section": {"radius": "12 mm"}, "material": {"density": 2700, "youngs_modulus": "7 GPa"}, "elements": {"count": 4}}],
      "supports": [{"beam": "b", "at": "start", "type": "clamped"}], "analysis": {"type": "static"},
      "output": {"probes": [{"name": "tip", "beam": "b", "at": "end"}]}})json",
                    R"json("variables": [
      {"name": "z1", "control_point": {"beam": "b", "index": 1, "axis": "z"}, "range": [-0.2, 0.2]}])json",
                    "at(end, tip.z)"),
            "");
  const std::string told = guide("1");
  EXPECT_NE(
      told.find("no derivative by \"w\": beam \"rail\" is divided into 1 rational cubics, and into 2 with "
                "another value"),
      std::string::npos)
      << told;
  EXPECT_EQ(guide("1.001"), "");
}

}  // namespace
}  // namespace nurbeam
