#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/study/followed_variant.h"

namespace nurbeam {
namespace {

using test::followed;
using test::FollowedVariant;
using test::plane_slide;
using test::slide_study;
using test::space_beam;
using test::space_study;
using test::spline_case;
using test::StudyOfCase;

/// The gradients of a study by adjoints, held to those by tangents, which are taken where there are as many
/// quantities as variables.
FollowedVariant expect_what_tangents_give(const std::string& case_text, const std::string& variables,
                                          const std::string& quantities, double accuracy) {
  const auto study = [&](const std::string& all) {
    return variables + R"json("quantities": [)json" + all + R"json(], "plan": {"grid": 2})json";
  };
  const StudyOfCase few(case_text, study(quantities));
  std::string all = quantities;
  for (const StudyVariable& variable : few.study.variables)
    all += R"json(, {"name": "of )json" + variable.name + R"json(", "value": ")json" + variable.name + "\"}";
  const StudyOfCase many(case_text, study(all));
  FollowedVariant by_adjoint = followed(few);
  const FollowedVariant direct = followed(many);
  EXPECT_LT(by_adjoint.work.solves, direct.work.solves);
  EXPECT_LE(by_adjoint.work.tangents, direct.work.tangents);
  for (std::size_t i = 0; i < by_adjoint.gradient.size(); ++i)
    for (std::size_t k = 0; k < by_adjoint.gradient[i].size(); ++k) {
      const std::vector<double>& range = few.study.variables[k].distribution.parameters;
      // Of the derivative, or of a hundredth of the quantity over the range where others cancel in it.
      const double size =
          std::max(std::abs(direct.gradient[i][k]),
                   0.01 * std::abs(by_adjoint.quantities[i]) / (range.back() - range.front()));
      EXPECT_NEAR(by_adjoint.gradient[i][k], direct.gradient[i][k], accuracy * size)
          << few.study.quantities[i].name << " by " << few.study.variables[k].name;
    }
  return by_adjoint;
}

/// Heights of the control points of a spline_case, from the third.
std::string heights(int points) {
  std::ostringstream variables;
  for (int i = 2; i < points; ++i)
    variables << R"json({"name": "z)json" << i
              << R"json(", "control_point": {"beam": "beam", "axis": "z", "index": )json" << i
              << R"json(}, "range": [-1, 1]}, )json";
  return variables.str();
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
TEST(GradientByAdjoint, OfARestIsWhatSolutionsForEachParameterGive) {
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
        // Wherever the search for a free body begins, derivatives of its place scatter by 3.5e-7: round-off
        // of the differences of residuals, which the stiff axial forces are large in.
        const double tolerance = where == "\"free\"" ? 1e-6 : 1e-7;
        EXPECT_NEAR(by_adjoint.gradient[i][k], direct[i][k], tolerance * size) << i << " by " << k;
      }
  }
}

TEST(GradientByAdjoint, OfAMotionIsWhatTangentsGive) {
  constexpr int points = 14;
  const std::string motion =
      spline_case(points, 16, R"json({"type": "dynamic", "end_time": 0.2, "step": "2 ms"})json");
  const std::string variables = "\"variables\": [" + heights(points) + R"json(
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]},
      {"name": "density", "path": "beams[0].material.density", "range": [2600, 2800]}], )json";
  const FollowedVariant one = expect_what_tangents_give(
      motion, variables, R"json({"name": "z", "value": "at(end, tip.z) + sqrt(E)"})json", 1e-5);
  EXPECT_EQ(one.work.solves, one.steps);
  // The last steps have no part in either.
  const FollowedVariant two =
      expect_what_tangents_give(motion, variables, R"json({"name": "speed", "value": "at(0.16, tip.speed)"},
      {"name": "m", "value": "at(0.12, root.my) * density"})json",
                                1e-5);
  EXPECT_EQ(two.work.solves % 2, 0);
  EXPECT_GE(two.work.solves, 2 * 60);
  EXPECT_LT(two.work.solves, 2 * two.steps);
}

// Where the greatest value is a record's, all derivatives are that record's.
TEST(GradientByAdjoint, OfTheGreatestValueOfAHistory) {
  constexpr int points = 14;
  const FollowedVariant variant = expect_what_tangents_give(
      spline_case(points, 16, R"json({"type": "dynamic", "end_time": 0.3, "step": "2 ms"})json"),
      "\"variables\": [" + heights(points) + R"json(
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]}], )json",
      R"json({"name": "least", "value": "min(tip.vz)"})json", 1e-5);
  EXPECT_LT(variant.work.solves, variant.steps);
}

// Of an energy, and of a tension, which is one element's: those by tangents are differences of it over a
// micrometre, where its round-off counts.
TEST(GradientByAdjoint, OfWhatTheWholeBeamHas) {
  constexpr int points = 14;
  const std::pair<const char*, double> quantities[] = {
      {"at(end, energy.kinetic)", 1e-5},        {"at(0.1, energy.bending)", 1e-5},
      {"at(0.16, beam.axial_force.max)", 1e-4}, {"at(end, beam.axial_force.min)", 1e-4},
      {"at(end, beam.moment.max)", 1e-5},       {"at(end, beam.stress.max)", 1e-5},
      {"at(0.1, beam.displacement.max)", 1e-6}, {"at(end, beam.length)", 1e-4},
      {"at(end, beam.shear_force.max)", 1e-4}};
  for (const auto& [quantity, accuracy] : quantities) {
    const FollowedVariant variant = expect_what_tangents_give(
        spline_case(points, 16, R"json({"type": "dynamic", "end_time": 0.2, "step": "2 ms"})json"),
        "\"variables\": [" + heights(points) + R"json(
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]}], )json",
        R"json({"name": "value", "value": ")json" + std::string(quantity) + "\"}", accuracy);
    EXPECT_LE(variant.work.solves, variant.steps) << quantity;
  }
}

/// A cable that hangs symmetrically, and heights of its control points.
const std::string hanging_cable = R"json({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "cable",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.5, 1, 1, 1, 1],
                         "control_points": [[0, 0, 0], [1, 0, -0.2], [3, 0, -0.33], [5, 0, -0.2], [6, 0, 0]]}},
      "section": {"radius": "6 mm"}, "material": {"density": 5200, "youngs_modulus": "2 GPa"},
      "elements": {"count": 8}}],
    "supports": [{"beam": "cable", "at": "start", "type": "pinned"}, {"beam": "cable", "at": "end", "type": "pinned"}],
    "output": {"every": 0.01, "probes": [{"name": "mid", "beam": "cable", "at": {"fraction": 0.3}}]},
    "analysis": {"type": "dynamic", "end_time": 0.02, "step": "1 ms"}})json";
const std::string heights_of_cable = R"json("variables": [
      {"name": "z1", "control_point": {"beam": "cable", "index": 1, "axis": "z"}, "range": [-0.3, -0.1]},
      {"name": "z2", "control_point": {"beam": "cable", "index": 2, "axis": "z"}, "range": [-0.4, -0.3]},
      {"name": "z3", "control_point": {"beam": "cable", "index": 3, "axis": "z"}, "range": [-0.3, -0.1]}], )json";

// The moment changes by so little that tangents, which are differences of it, have but two of its digits.
TEST(GradientByAdjoint, OfASagAndASection) {
  for (const auto& [quantity, accuracy] : {std::pair{"at(end, cable.sag)", 1e-6},
                                           {"at(0.01, mid.moment)", 1e-2},
                                           {"at(end, mid.axial_force)", 1e-4}})
    expect_what_tangents_give(hanging_cable, heights_of_cable,
                              R"json({"name": "value", "value": ")json" + std::string(quantity) + "\"}",
                              accuracy);
}

/// The derivative of the first quantity by the first variable, as a difference of runs.
double difference_of_runs(StudyOfCase& of, double h) {
  const auto of_variant = [&](double change) {
    std::vector<double> values = of.nominal();
    values[0] += change;
    return of.run(values, false).quantities[0];
  };
  return (of_variant(h) - of_variant(-h)) / (2 * h);
}

// In a symmetrical shape two elements have the greatest tension, and what changes it in one of them alone
// tells of both sides half; or the middle has the greatest sag, which is a node of two.
TEST(GradientByAdjoint, OfAnExtremeThatTwoPlacesShare) {
  for (const std::string quantity :
       {"cable.axial_force.max", "cable.moment.max", "cable.displacement.max", "cable.stress.max"}) {
    StudyOfCase of(hanging_cable, heights_of_cable + R"json(
    "quantities": [{"name": "greatest", "value": "at(end, )json" +
                                      quantity + R"json()"}], "plan": {"grid": 2})json");
    const FollowedVariant variant = followed(of);
    EXPECT_EQ(variant.work.solves, variant.steps) << quantity;
    const double difference = difference_of_runs(of, 1e-5);
    EXPECT_NEAR(variant.gradient[0][0], difference, 1e-3 * std::abs(difference)) << quantity;
  }
}

// A straight bar that is drawn out is as tense everywhere.
TEST(GradientByAdjoint, IsLeftToTangentsWhereManyPlacesShareAnExtreme) {
  StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, 0], "beams": [{"name": "bar",
      "axis": {"polyline": [[0, 0, 0], [2, 0, 0]]},
      "section": {"radius": "6 mm"}, "material": {"density": 5200, "youngs_modulus": "2 GPa"},
      "elements": {"count": 8}}],
    "supports": [{"beam": "bar", "at": "start", "type": "pinned"}],
    "loads": [{"beam": "bar", "at": "end", "force": [100, 0, 0]}],
    "output": {"every": 0.1},
    "analysis": {"type": "dynamic", "initial": "equilibrium", "end_time": 0.2, "step": "10 ms"}})json",
                 R"json("variables": [
      {"name": "x", "control_point": {"beam": "bar", "index": 1, "axis": "x"}, "range": [1.9, 2.1]},
      {"name": "F", "path": "loads[0].force[0]", "range": [90, 110]}],
    "quantities": [{"name": "greatest", "value": "at(end, bar.axial_force.max)"}], "plan": {"grid": 2})json");
  const FollowedVariant variant = followed(of);
  EXPECT_EQ(variant.work.solves, 2 * (variant.steps + 1));  // and the equilibrium that it begins from
  EXPECT_NEAR(variant.gradient[0][1], 1, 1e-5);
}

// The witness is no tangent.
TEST(GradientByAdjoint, OfAMotionIsWhatDifferencesOfRunsTendTo) {
  constexpr int points = 10;
  StudyOfCase of(spline_case(points, 8, R"json({"type": "dynamic", "end_time": 0.12, "step": "2 ms"})json"),
                 "\"variables\": [" + heights(points) + R"json(
      {"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]}],
      "quantities": [{"name": "z", "value": "at(end, tip.z)"}], "plan": {"grid": 2})json");
  const FollowedVariant by_adjoint = followed(of);
  ASSERT_EQ(by_adjoint.work.solves, by_adjoint.steps);
  test::expect_gradient(of, 0.0005, 1e-5);
}

// What a run of as many steps takes two or three times: a matrix is taken in each step, and what numbers
// of the elements do to it.
TEST(GradientByAdjoint, ByTwentyControlPointsTakesFewEvaluations) {
  std::string variables = heights(22);
  variables.erase(variables.rfind(','));
  const StudyOfCase of(
      spline_case(22, 80, R"json({"type": "dynamic", "end_time": 0.04, "step": "2 ms"})json"),
      "\"variables\": [" + variables + R"json(],
    "quantities": [{"name": "z", "value": "at(end, tip.z)"}], "plan": {"gradient": "nominal"})json");
  const FollowedVariant variant = followed(of);
  ASSERT_EQ(variant.steps, 20);
  EXPECT_EQ(variant.work.tangents, variant.steps);
  EXPECT_EQ(variant.work.solves, variant.steps);
  EXPECT_LT(variant.work.residuals, 5 * 20);
  EXPECT_GT(variant.work.residuals, 3 * 20);
}

// All of a history takes a derivative by each of its states, which would be more than tangents are.
TEST(GradientByAdjoint, IsLeftToTangentsWhereTheseTakeLess) {
  std::string variables = heights(14);
  variables.erase(variables.rfind(','));
  std::string motion = spline_case(14, 16, R"json({"type": "dynamic", "end_time": 0.2, "step": "2 ms"})json");
  motion.replace(motion.find("\"every\": 0.02"), 13, "\"every\": 0.004");
  const FollowedVariant variant = followed(StudyOfCase(motion, "\"variables\": [" + variables + R"json(],
    "quantities": [{"name": "work", "value": "integral(tip.vz)"}], "plan": {"grid": 2})json"));
  EXPECT_EQ(variant.work.solves, 12 * variant.steps);
}

TEST(GradientByAdjoint, OfADampedMotionInSpaceUnderErrorControl) {
  std::string beam = space_beam;
  beam.replace(beam.find("\"density\""), 9, R"json("damping": "2 ms", "mass_damping": 0.4, "density")json");
  std::string variables = space_study;
  variables.insert(variables.find('[') + 1, R"json(
      {"name": "z3", "control_point": {"beam": "beam", "index": 3, "axis": "z"}, "range": [0.2, 0.4]},
      {"name": "x3", "control_point": {"beam": "beam", "index": 3, "axis": "x"}, "range": [0.8, 1]},
      {"name": "y3", "control_point": {"beam": "beam", "index": 3, "axis": "y"}, "range": [1.4, 1.6]},
      {"name": "w1", "weight": {"beam": "beam", "index": 1}, "range": [0.8, 1.2]},)json");
  const FollowedVariant variant = expect_what_tangents_give(
      R"json({"nurbeam": 1, )json" + beam + R"json(
    "analysis": {"type": "dynamic", "end_time": 0.4, "tolerance": 1e-5},
    "output": {"every": 0.05, "probes": [{"name": "tip", "beam": "beam", "at": "end"}]}})json",
      variables, R"json({"name": "y", "value": "at(end, tip.y) + 0.1 * at(0.2, tip.speed)"})json", 1e-7);
  EXPECT_EQ(variant.work.solves, variant.steps);
}

// The tangents go over the changes of the mesh, adjoints over what comes behind the last.
TEST(GradientByAdjoint, BehindChangesOfTheMesh) {
  const FollowedVariant variant = expect_what_tangents_give(
      plane_slide + R"json("analysis": {"type": "dynamic", "end_time": 0.36, "step": "1 ms"},
    "output": {"every": 0.1}})json",
      slide_study, R"json({"name": "s", "value": "at(end, slider.s)"})json", 1e-5);
  EXPECT_GT(variant.events.size(), 2U);
  EXPECT_LT(variant.work.solves, 7 * variant.steps - 20);
}

// The time at which the body leaves changes with the parameters, and the motion is driven over time from then
// on too.
TEST(GradientByAdjoint, BehindABodyThatHasLeft) {
  std::string slide = plane_slide;
  const auto replace = [&](const std::string& what, const std::string& by) {
    slide.replace(slide.find(what), what.size(), by);
  };
  replace(R"json("speed": 1})json", R"json("speed": 6, "at_beam_end": "leave"})json");
  replace(
      R"json(,
                 {"beam": "beam", "at": "end", "type": "pinned"}], )json",
      R"json(], "loads": [{"beam": "beam", "at": "end", "force": [3, 0, 5], "time": [[0, 0.2], [2, 1]]}], )json");
  std::string study = slide_study;
  study.replace(study.find("\"range\": [0, 2], \"nominal\": 1"), 29, "\"range\": [5, 7], \"nominal\": 6");
  const FollowedVariant variant = expect_what_tangents_give(
      slide + R"json("analysis": {"type": "dynamic", "end_time": 0.8, "step": "1 ms"},
    "output": {"every": 0.1, "probes": [{"name": "tip", "beam": "beam", "at": "end"}]}})json",
      study, R"json({"name": "z", "value": "at(end, tip.z) + at(end, slider.x) + time(leaves, slider)"})json",
      1e-5);
  EXPECT_FALSE(variant.events.empty());
  EXPECT_LT(variant.work.solves, 6 * variant.steps);
}

}  // namespace
}  // namespace nurbeam
