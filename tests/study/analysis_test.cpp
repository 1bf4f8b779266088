#include "pipelines/study/analysis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "pipelines/study/study_output.h"
#include "pipelines/study/variant.h"
#include "tests/study/study_text.h"

namespace nurbeam {
namespace {

using test::study_of;

/// Runs variants of a study without a case in this process.
StudyPoints evaluated(const StudyFile& study, const StudyPoints& points) {
  StudyPoints quantities;
  for (const std::vector<double>& point : points)
    quantities.push_back(run_variant(study, nullptr, quantities.size(), all_values(study, point)).quantities);
  return quantities;
}
StudyEvaluation evaluation_of(const StudyFile& study) {
  return [&study](const StudyPoints& points) { return evaluated(study, points); };
}

StudyDerivatives derivatives_of(const StudyFile& study) {
  return [&study](const std::vector<double>& point) {
    return run_variant(study, nullptr, 0, all_values(study, point)).gradient;
  };
}

const std::string ishigami_head = R"json({"nurbeam_study": 1,
  "variables": [{"name": "x1", "range": [-3.141592653589793, 3.141592653589793]},
                {"name": "x2", "range": [-3.141592653589793, 3.141592653589793]},
                {"name": "x3", "range": [-3.141592653589793, 3.141592653589793]}],
  "quantities": [{"name": "y", "value": "sin(x1) + 7 * sin(x2)^2 + 0.1 * x3^4 * sin(x1)"}], )json";

// Ishigami and Homma's function, a = 7, b = 0.1: variances in closed form.
TEST(SobolIndices, OfIshigamisFunctionAreWithinTheirIntervals) {
  constexpr double a = 7, b = 0.1, p4 = 97.40909103400244, p8 = 9488.531016070574;  // pi^4, pi^8
  const double v1 = 0.5 * std::pow(1 + b * p4 / 5, 2), v2 = a * a / 8,
               v13 = b * b * p8 * (1.0 / 18 - 1.0 / 50);
  const double v = v1 + v2 + v13;
  const StudyFile study = study_of(ishigami_head + R"json("sensitivity": {"count": 4096}})json");
  const SensitivityResult result =
      sobol_indices(study, std::get<StudySensitivity>(study.task), evaluation_of(study));
  const double first[] = {v1 / v, v2 / v, 0}, total[] = {(v1 + v13) / v, v2 / v, v13 / v};
  ASSERT_EQ(result.indices.size(), 1U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GE(first[i], result.indices[0].first_order[i].lower - 0.01) << i;
    EXPECT_LE(first[i], result.indices[0].first_order[i].upper + 0.01) << i;
    EXPECT_GE(total[i], result.indices[0].total_order[i].lower - 0.01) << i;
    EXPECT_LE(total[i], result.indices[0].total_order[i].upper + 0.01) << i;
    EXPECT_LE(result.indices[0].first_order[i].upper - result.indices[0].first_order[i].lower, 0.2);
  }
}

// The exact index is 1, and its interval is to hold it in 95 % of all samples.
TEST(SobolIndices, OfOneVariableLieWithinTheirIntervalsAsOftenAsThoseSay) {
  constexpr int samples = 200;
  int first = 0, total = 0;
  for (int seed = 1; seed <= samples; ++seed) {
    const StudyFile study = study_of(R"json({"nurbeam_study": 1,
      "variables": [{"name": "a", "distribution": {"normal": {"mean": 0, "sd": 1}}}],
      "quantities": [{"name": "f", "value": "a"}], "sensitivity": {"count": 64}, "seed": )json" +
                                     std::to_string(seed) + "}");
    const SobolIndices f =
        sobol_indices(study, std::get<StudySensitivity>(study.task), evaluation_of(study)).indices[0];
    for (const SobolIndices::Index& index : {f.first_order[0], f.total_order[0]}) {
      EXPECT_LT(index.lower, index.value);
      EXPECT_GT(index.upper, index.value);
    }
    first += f.first_order[0].lower <= 1 && 1 <= f.first_order[0].upper ? 1 : 0;
    total += f.total_order[0].lower <= 1 && 1 <= f.total_order[0].upper ? 1 : 0;
  }
  EXPECT_GE(first, 0.90 * samples);  // three standard deviations of the count below 95 %
  EXPECT_GE(total, 0.90 * samples);
}

TEST(SobolIndices, OfWhatIsTheSameInAllVariantsAreZero) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "x", "range": [0, 1]}, {"name": "y", "range": [0, 1]}],
    "quantities": [{"name": "same", "value": "3 + 1e-15 * x"}, {"name": "f", "value": "x + 0 * y"}],
    "sensitivity": {"count": 64}})json");
  const SensitivityResult result =
      sobol_indices(study, std::get<StudySensitivity>(study.task), evaluation_of(study));
  ASSERT_EQ(result.indices.size(), 2U);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(result.indices[0].total_order[i].value, 0);
  EXPECT_NEAR(result.indices[1].total_order[0].value, 1, 0.1);
}

TEST(Surrogate, OfIshigamisFunctionHasItsSobolIndices) {
  const StudyFile study = study_of(
      ishigami_head + R"json("plan": {"latin_hypercube": {"count": 600}}, "surrogate": {"degree": 9}})json");
  const StudyPoints points = plan_points(study, std::get<StudyPlan>(study.task));
  const SurrogateResult chaos = make_surrogates(study, *study.surrogate, points, evaluated(study, points))[0];
  EXPECT_GE(chaos.q2, 0.99);
  EXPECT_NEAR(chaos.first_order[0], 0.3139, 0.01);
  EXPECT_NEAR(chaos.total_order[2], 0.2437, 0.01);
}

// A modulus and a radius: numbers of 1e11 and of 0.01.
TEST(Surrogate, ByKrigingAnswersWhateverTheUnits) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "E", "range": [1e11, 3e11]}, {"name": "r", "range": [0.005, 0.02]}],
    "quantities": [{"name": "y", "value": "E / 1e11 * sin(300 * r)"}],
    "plan": {"latin_hypercube": {"count": 100}}, "surrogate": {"type": "kriging"}})json");
  const StudyPoints points = plan_points(study, std::get<StudyPlan>(study.task));
  EXPECT_GE(make_surrogates(study, *study.surrogate, points, evaluated(study, points))[0].q2, 0.99);
}

// Rows held back that are all alike have no variance, of which it could explain a part.
TEST(Surrogate, ThatMissesRowsThatAreAllAlikeIsNotExact) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "x", "range": [-1, 1]}], "quantities": [{"name": "y", "value": "x^4"}],
    "plan": {"grid": 10}, "surrogate": {"degree": 1, "held_back": 0.2}})json");
  const StudyPoints points = {{-1}, {-0.6}, {-0.2}, {0.2}, {0.6}, {-0.8}, {0.8}, {1}, {-0.9}, {0.9}};
  // All rows are of one value but for one.
  StudyPoints quantities(points.size(), {0});
  int missed = 0;
  for (std::size_t fit = 0; fit < points.size(); ++fit) {
    quantities[fit] = {1};
    const SurrogateResult made = make_surrogates(study, *study.surrogate, points, quantities)[0];
    if (made.largest_error > 1e-9) {
      ++missed;
      EXPECT_LT(made.q2, 1) << fit;
    }
    quantities[fit] = {0};
  }
  EXPECT_GT(missed, 5);
}

// Beside one that does vary.
TEST(Surrogate, OfWhatDoesNotVaryHasNoIndices) {
  for (const char* type : {"chaos", "kriging"})
    for (const char* constant : {"x > 5", "0 * x + 1", "or(0, x)"}) {
      const StudyFile study = study_of(std::string(R"json({"nurbeam_study": 1,
    "variables": [{"name": "x", "range": [0, 1]}, {"name": "y", "range": [0, 1]}],
    "quantities": [{"name": "f", "value": ")json") +
                                       constant + R"json("}, {"name": "g", "value": "x + y"}],
    "plan": {"latin_hypercube": {"count": 50}}, "surrogate": {"type": ")json" +
                                       type + "\"}}");
      const StudyPoints points = plan_points(study, std::get<StudyPlan>(study.task));
      const std::vector<SurrogateResult> made =
          make_surrogates(study, *study.surrogate, points, evaluated(study, points));
      ASSERT_EQ(made.size(), 2U) << type << constant;
      EXPECT_EQ(made[0].q2, 1);
      EXPECT_EQ(made[0].largest_error, 0);
      for (const double index : made[0].first_order) EXPECT_EQ(index, 0);
      EXPECT_EQ(made[0].total_order.size(), std::string(type) == "chaos" ? 2U : 0U);
      EXPECT_GE(made[1].q2, 0.999) << type << constant;
    }
}

TEST(Surrogate, ThatHasMoreTermsThanRowsIsRefused) {
  const auto plan = [](int count) {
    return ishigami_head + R"json("plan": {"latin_hypercube": {"count": )json" + std::to_string(count) +
           R"json(}}, "surrogate": {"degree": 9}})json";
  };
  EXPECT_NE(test::wrong_with(plan(274)).find(
                "study.json: surrogate: polynomials of degree 9 have 220 terms, more than "
                "the 219 of 274 variants that are not held back"),
            std::string::npos)
      << test::wrong_with(plan(274));
  // Enough, but not all of them are done.
  const StudyFile study = study_of(plan(275));
  StudyPoints points = plan_points(study, std::get<StudyPlan>(study.task));
  points.pop_back();
  EXPECT_THROW(make_surrogates(study, *study.surrogate, points, evaluated(study, points)),
               std::runtime_error);
}

TEST(Plan, OfALatinHypercubeHasOneValueInEachLayer) {
  const StudyFile study =
      study_of(ishigami_head + R"json("plan": {"latin_hypercube": {"count": 40}}, "seed": 3})json");
  const StudyPoints points = plan_points(study, std::get<StudyPlan>(study.task));
  ASSERT_EQ(points.size(), 40U);
  for (int k = 0; k < 3; ++k) {
    std::set<int> layers;
    for (const auto& point : points) layers.insert(static_cast<int>((point[k] + M_PI) / (2 * M_PI) * 40));
    EXPECT_EQ(layers.size(), 40U);
  }
  EXPECT_EQ(points, plan_points(study, std::get<StudyPlan>(study.task))) << "the seed decides";
}

TEST(Plan, OfAGridHasAllCombinationsAndItsEnds) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "a", "range": [0, 1]}, {"name": "b", "range": [10, 20]}],
    "quantities": [{"name": "y", "value": "a + b"}], "plan": {"grid": [2, 3]}})json");
  const StudyPoints points = plan_points(study, std::get<StudyPlan>(study.task));
  EXPECT_EQ(points, (StudyPoints{{0, 10}, {0, 15}, {0, 20}, {1, 10}, {1, 15}, {1, 20}}));
}

const std::string linear_head = R"json({"nurbeam_study": 1,
  "variables": [{"name": "R", "distribution": {"normal": {"mean": 10, "sd": 1.5}}},
                {"name": "S", "distribution": {"normal": {"mean": 5, "sd": 2}}}],
  "quantities": [{"name": "margin", "value": "R - S"}], )json";

TEST(Reliability, OfALinearLimitIsExactByForm) {
  const StudyFile study =
      study_of(linear_head + R"json("reliability": {"quantity": "margin", "below": 0}})json");
  const ReliabilityResult result =
      failure_probability(study, std::get<StudyReliability>(study.task), evaluation_of(study));
  const double beta = 5 / 2.5;  // (10 - 5) / hypot(1.5, 2)
  EXPECT_NEAR(*result.reliability_index, beta, 1e-6);
  EXPECT_NEAR(result.probability, 0.5 * std::erfc(beta / std::sqrt(2.0)), 1e-7);
  EXPECT_NEAR(result.importance[1], 0.64, 1e-6);
  EXPECT_NEAR(result.design_point[0], 10 - 1.5 * 0.6 * beta, 1e-5);
}

// Numbers of 1e11 and of 0.01 with the last digits rounded off, as runs have them; ln S - ln R is normal.
TEST(Reliability, OfRoundedQuantitiesIsFoundInFewVariants) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "R", "distribution": {"lognormal": {"mean": 2e11, "sd": 2e10}}},
                  {"name": "S", "distribution": {"lognormal": {"mean": 0.01, "sd": 0.002}}}],
    "quantities": [{"name": "use", "value": "1e13 * S / R"}],
    "reliability": {"quantity": "use", "above": 1}})json");
  int runs = 0;
  const StudyEvaluation rounded = [&](const StudyPoints& points) {
    StudyPoints quantities = evaluated(study, points);
    runs += static_cast<int>(points.size());
    for (auto& row : quantities) row[0] = std::round(row[0] * 1e9) / 1e9;
    return quantities;
  };
  const ReliabilityResult result =
      failure_probability(study, std::get<StudyReliability>(study.task), rounded);
  const double of_r = std::log(1 + 0.1 * 0.1), of_s = std::log(1 + 0.2 * 0.2);  // variances of the logarithms
  const double margin = (std::log(2e11) - of_r / 2) - (std::log(0.01) - of_s / 2) - std::log(1e13);
  EXPECT_NEAR(*result.reliability_index, margin / std::sqrt(of_r + of_s), 1e-5);
  EXPECT_LE(runs, 80);
}

TEST(Reliability, BySimulationIsWithinItsDeviation) {
  const double exact = 0.5 * std::erfc(2 / std::sqrt(2.0));
  for (const char* method : {"importance_sampling", "monte_carlo"}) {
    const StudyFile study = study_of(linear_head +
                                     R"json("reliability": {"quantity": "margin", "below": 0, "count": 6000,
      "method": ")json" + method + "\"}}");
    const ReliabilityResult result =
        failure_probability(study, std::get<StudyReliability>(study.task), evaluation_of(study));
    EXPECT_NEAR(result.probability, exact, 4 * *result.coefficient_of_variation * exact) << method;
    EXPECT_LE(*result.coefficient_of_variation, 0.12) << method;
  }
}

// R - S is below 12 with nearly all values: Phi(2.8).
TEST(Reliability, OfWhatMostlyFailsIsThatOfTheRestAndItsIndexIsNegative) {
  const double beta = -(12 - 5) / 2.5, exact = 0.5 * std::erfc(beta / std::sqrt(2.0));
  for (const char* method : {"form", "importance_sampling"}) {
    const StudyFile study = study_of(linear_head +
                                     R"json("reliability": {"quantity": "margin", "below": 12, "count": 2000,
      "method": ")json" + method + "\"}}");
    const ReliabilityResult result =
        failure_probability(study, std::get<StudyReliability>(study.task), evaluation_of(study));
    EXPECT_NEAR(*result.reliability_index, beta, 1e-5) << method;
    EXPECT_NEAR(result.probability, exact, 0.1 * (1 - exact)) << method;
    if (result.coefficient_of_variation)
      EXPECT_LE(*result.coefficient_of_variation, 0.1 * (1 - exact)) << method;
  }
}

TEST(Reliability, BySimulationRunsAsManyAsAskedForOrUntilItIsSure) {
  const auto runs = [](const std::string& more) {
    const StudyFile study = study_of(linear_head + R"json("reliability": {"quantity": "margin", "below": 4,
      "method": "monte_carlo", "count": 2000)json" +
                                     more + "}}");
    std::size_t count = 0;
    failure_probability(study, std::get<StudyReliability>(study.task), [&](const StudyPoints& points) {
      count += points.size();
      return evaluated(study, points);
    });
    return count;
  };
  EXPECT_EQ(runs(""), 2000U);
  // Sure of 0.03 after 2157 of them.
  EXPECT_EQ(runs(R"(, "coefficient_of_variation": 0.03)"), 2000U);
  const std::size_t until_sure =
      runs(R"(, "coefficient_of_variation": 0.1)");  // sqrt((1 - p) / (p n)), p = 0.34
  EXPECT_GE(until_sure, 120U);
  EXPECT_LE(until_sure, 300U);
}

// x is normal; those from 1 on are not done.
TEST(Reliability, CountsWhatIsNotDoneAsWhatDoesNotFail) {
  for (const auto& [limit, method, exact] : {std::tuple{"\"above\": 2", "monte_carlo", 0.0},
                                             {"\"below\": -1", "monte_carlo", 0.158655},
                                             {"\"below\": -1", "importance_sampling", 0.158655}}) {
    const StudyFile study = study_of(R"json({"nurbeam_study": 1,
      "variables": [{"name": "x", "distribution": {"normal": {"mean": 0, "sd": 1}}}],
      "constraints": ["x < 1"], "quantities": [{"name": "q", "value": "x"}],
      "reliability": {"quantity": "q", "count": 2000, )json" +
                                     std::string(limit) + ", \"method\": \"" + method + "\"}}");
    const ReliabilityResult result =
        failure_probability(study, std::get<StudyReliability>(study.task), evaluation_of(study));
    EXPECT_NEAR(result.probability, exact, 0.15 * exact) << limit << method;
    EXPECT_EQ(result.coefficient_of_variation.has_value(), exact > 0);
  }
}

TEST(Reliability, ByFormThatDoesNotEndIsNoAnswer) {
  const auto found = [](const std::string& count) {
    const StudyFile study = study_of(R"json({"nurbeam_study": 1,
      "variables": [{"name": "x", "distribution": {"normal": {"mean": 0, "sd": 1}}},
                    {"name": "y", "distribution": {"normal": {"mean": 0, "sd": 1}}}],
      "quantities": [{"name": "g", "value": "x + y + 0.2 * sin(3 * x)"}],
      "reliability": {"quantity": "g", "above": 4, "count": )json" +
                                     count + "}}");
    return failure_probability(study, std::get<StudyReliability>(study.task), evaluation_of(study));
  };
  EXPECT_THROW(found("10"), std::runtime_error);
  EXPECT_GT(*found("1000").reliability_index, 2);
}

TEST(Optimum, OfTwoObjectivesIsAFrontInOrder) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "x", "range": [0, 1]}, {"name": "y", "range": [0, 1]}],
    "quantities": [{"name": "f", "value": "x"}, {"name": "g", "value": "1 - x + y"}],
    "optimise": {"minimise": ["f", "g"], "evaluations": 400}})json");
  const OptimumResult front = find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study));
  ASSERT_GT(front.quantities.size(), 20U);
  for (std::size_t i = 0; i + 1 < front.quantities.size(); ++i) {
    EXPECT_LT(front.quantities[i][0], front.quantities[i + 1][0]);
    EXPECT_GT(front.quantities[i][1], front.quantities[i + 1][1]);
  }
  EXPECT_EQ(front.points[0][0], front.quantities[0][0]);
  const std::string told = answer_text(study, {.answer = front});
  EXPECT_NE(told.find("the first 20 of them, by the first objective; study.json has all"), std::string::npos)
      << told;
}

TEST(Plan, IsAnsweredByTheRangesOfItsQuantities) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1, "variables": [{"name": "x", "range": [0, 1]}],
    "quantities": [{"name": "f", "value": "x", "unit": "mm"}], "plan": {"grid": 3}})json");
  StudyResult result;
  for (const double f : {2.5, -1.0, 7.0, 100.0})
    result.variants.push_back(
        {.number = result.variants.size(), .values = {f / 10}, .quantities = {f}, .gradient = {{0.5}}});
  result.variants.back().status = VariantStatus::failed;
  const std::string ranges = "f  -1 mm (variant 1: x = -0.1) to 7 mm (variant 2: x = 0.7)\n";
  EXPECT_EQ(answer_text(study, result), ranges);
  result.answer = GradientResult{result.variants};
  EXPECT_TRUE(answer_text(study, result).starts_with(ranges)) << answer_text(study, result);
  result.answer = std::monostate{};
  result.variants.clear();
  EXPECT_EQ(answer_text(study, result), "");
}

// Its value hardly changes, far from zero or near it.
TEST(Optimum, IsFoundWhateverTheSizeOfWhatIsMinimised) {
  for (const char* method : {"cobyla", "nelder_mead", "gradient"})
    for (const char* f : {"1e-6 * ((x - 0.3)^2 + (y - 0.8)^2)", "100 + 0.02 * ((x - 0.3)^2 + (y - 0.8)^2)"}) {
      const StudyFile study = study_of(R"json({"nurbeam_study": 1,
        "variables": [{"name": "x", "range": [0, 1]}, {"name": "y", "range": [0, 1]}],
        "quantities": [{"name": "f", "value": ")json" +
                                       std::string(f) + R"json("}],
        "optimise": {"minimise": "f", "evaluations": 400, "tolerance": 1e-4, "method": ")json" +
                                       method + "\"}}");
      const OptimumResult result =
          find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study));
      EXPECT_NEAR(result.points[0][0], 0.3, 2e-3) << method << f;
      EXPECT_NEAR(result.points[0][1], 0.8, 2e-3) << method << f;
      EXPECT_FALSE(result.cut_off) << method << f;
    }
}

// Rosenbrock's valley is too long for so few variants. Some methods ask twice for where they go on from.
TEST(Optimum, SaysThatItsEvaluationsAreUsedUp) {
  for (const char* method : {"cobyla", "nelder_mead", "gradient"}) {
    const StudyFile study = study_of(R"json({"nurbeam_study": 1,
      "variables": [{"name": "x", "range": [-2, 2]}, {"name": "y", "range": [-2, 2]}],
      "quantities": [{"name": "f", "value": "(1 - x)^2 + 100 * (y - x^2)^2"}],
      "optimise": {"minimise": "f", "evaluations": 12, "method": ")json" +
                                     std::string(method) + "\"}}");
    const OptimumResult result =
        find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study), derivatives_of(study));
    EXPECT_EQ(result.history.size(), 12U) << method;
    EXPECT_TRUE(result.cut_off) << method;
  }
}

// Each variant of the search comes with four more.
TEST(Optimum, DoesNotCountDifferencesAsEvaluations) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "x", "range": [-2, 2], "nominal": 1}, {"name": "y", "range": [-2, 2], "nominal": 1.5}],
    "quantities": [{"name": "f", "value": "x^2 + y^2 + x^4"}],
    "optimise": {"minimise": "f", "evaluations": 30, "method": "gradient", "derivatives": "differences"}})json");
  const OptimumResult result = find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study));
  EXPECT_GT(result.history.size(), 30U);
  EXPECT_NEAR(result.history.back(), 0, 1e-6);
  EXPECT_FALSE(result.cut_off);
}

TEST(Optimum, OfWhatIsMaximisedHasItsOwnSign) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1, "variables": [{"name": "x", "range": [-2, 2]}],
    "quantities": [{"name": "f", "value": "3 - (x - 1)^2"}],
    "optimise": {"maximise": "f", "evaluations": 60, "method": "cobyla"}})json");
  EXPECT_NEAR(find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study)).history.back(), 3,
              1e-3);
}

TEST(Optimum, HoldsItsConstraints) {
  for (const char* method : {"cobyla", "gradient"}) {
    const StudyFile study = study_of(R"json({"nurbeam_study": 1,
      "variables": [{"name": "x", "range": [-5, 5]}, {"name": "y", "range": [-5, 5]}],
      "quantities": [{"name": "f", "value": "(x - 2)^2 + (y - 1)^2"}, {"name": "g", "value": "x + y"}],
      "optimise": {"minimise": "f", "subject_to": ["g <= 2", "y >= 0"], "evaluations": 300, "tolerance": 1e-6,
                   "method": ")json" +
                                     std::string(method) + "\"}}");
    const OptimumResult result =
        find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study));
    EXPECT_NEAR(result.points[0][0], 1.5, 1e-3) << method;
    EXPECT_NEAR(result.points[0][1], 0.5, 1e-3) << method;
    EXPECT_NEAR(result.history.back(), 0.5, 1e-3);
  }
}

// A second moment of area of 5e-10 m^4, of which no fixed tolerance knows how small it is.
TEST(Optimum, HoldsConstraintsOfSmallNumbersAsOthers) {
  for (const char* method : {"cobyla", "gradient", "genetic"}) {
    const StudyFile study = study_of(R"json({"nurbeam_study": 1,
      "variables": [{"name": "r", "range": [0.002, 0.02]}],
      "quantities": [{"name": "I", "value": "3.141592653589793 / 4 * r^4"}, {"name": "mass", "value": "r^2"}],
      "optimise": {"minimise": "mass", "subject_to": ["I >= 5e-10"], "evaluations": 400, "tolerance": 1e-7,
                   "method": ")json" +
                                     std::string(method) + "\"}}");
    const OptimumResult result =
        find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study));
    const double exact = std::pow(4 * 5e-10 / 3.141592653589793, 0.25);
    EXPECT_GE(result.points[0][0], exact * (1 - 1e-8)) << method;
    EXPECT_LE(result.points[0][0], exact * (method == std::string("genetic") ? 1.02 : 1 + 1e-5)) << method;
  }
}

// Problems at whose ends a search misses its constraint by 1e-8 to 1e-3, with what is the least: the first
// one along gradients, the second without a variant that holds it, the third where COBYLA goes round and
// round.
TEST(Optimum, EndsWithAVariantThatHoldsItsConstraints) {
  for (const auto& [f, constraint, method, least] :
       {std::tuple{"0.6377706197300419*(x-0.2883924339166324)^2+1.2798419650411421*(y-1.0556107696995278)^2",
                   "0.22578438911091797*x^2+0.3064153962004147*y^2 <= 0.2649360739997162", "gradient",
                   0.029809183546221},
        {"1.7120313742701134*(x+0.7743666645567867)^2+2.3669040331394715*(y-1.8885937353296836)^2",
         "0.8879896499194682*x^2+0.9950536494833679*y^2 <= 0.21016767515495188", "cobyla", 5.8600269620316},
        {"0.9736764394664277*(x+0.567991374942227)^2+0.5755751303409931*(y-1.152115178318704)^2",
         "0.2597833348716704*x^2+0.4272861992669107*y^2 <= 0.2575396150170699", "cobyla", 0.3953888604155}}) {
    const StudyFile study = study_of(R"json({"nurbeam_study": 1,
      "variables": [{"name": "x", "range": [0, 1]}, {"name": "y", "range": [0, 1]}],
      "quantities": [{"name": "f", "value": ")json" +
                                     std::string(f) + R"json("}],
      "optimise": {"minimise": "f", "evaluations": 400, "subject_to": [")json" +
                                     constraint + "\"], \"method\": \"" + method + "\"}}");
    const OptimumResult result =
        find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study), derivatives_of(study));
    EXPECT_NEAR(result.quantities[0][0], least, 5e-4) << constraint;
    EXPECT_EQ(result.not_converged, "") << constraint;
    EXPECT_FALSE(result.cut_off) << constraint;
  }
}

// The least of x^2 + 2 y^2 on the line x + y = 1, from both sides of it; nothing beyond the line is run.
TEST(Optimum, HoldsTheConstraintsOfVariables) {
  for (const char* method : {R"("cobyla")", R"("gradient")", R"("gradient", "derivatives": "differences")"})
    for (const char* nominal : {"1.5", "-1"}) {
      const StudyFile study = study_of(R"json({"nurbeam_study": 1,
        "variables": [{"name": "x", "range": [-2, 2], "nominal": )json" +
                                       std::string(nominal) + R"json(}, {"name": "y", "range": [-2, 2]}],
        "constraints": ["x + y >= 1"], "quantities": [{"name": "f", "value": "x^2 + 2 * y^2"}],
        "optimise": {"minimise": "f", "method": )json" +
                                       method + "}}");
      const StudyEvaluation inside = [&](const StudyPoints& points) {
        for (const std::vector<double>& point : points) EXPECT_GE(point[0] + point[1], 1) << method;
        return evaluated(study, points);
      };
      StudyDerivatives derivatives;
      if (study.derivatives) derivatives = derivatives_of(study);
      const OptimumResult result =
          find_optimum(study, std::get<StudyOptimum>(study.task), inside, derivatives);
      EXPECT_NEAR(result.points[0][0], 2.0 / 3, 1e-3) << method << nominal;
      EXPECT_NEAR(result.points[0][1], 1.0 / 3, 1e-3) << method << nominal;
      EXPECT_NEAR(result.quantities[0][0], 2.0 / 3, 1e-6) << method << nominal;
    }
}

// A step has no slope that leads back over it.
TEST(Optimum, SaysThatASearchDidNotConverge) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "x", "range": [0, 1], "nominal": 0.8}],
    "quantities": [{"name": "f", "value": "x^2"}, {"name": "g", "value": "x > 0.6"}],
    "optimise": {"minimise": "f", "subject_to": ["g >= 0.5"], "method": "gradient"}})json");
  const OptimumResult result =
      find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study), derivatives_of(study));
  EXPECT_NE(result.not_converged.find("the search did not converge: it ended at x = "), std::string::npos)
      << result.not_converged;
  EXPECT_NE(result.not_converged.find(", which misses \"g >= 0.5\" by 0.5, and the best"), std::string::npos)
      << result.not_converged;
}

TEST(Variant, WithoutADerivativeHasFailed) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "x", "range": [0, 3], "nominal": 1}],
    "quantities": [{"name": "f", "value": "sqrt(x)"}], "plan": {"gradient": [[0], [1]]}})json");
  const Variant at_0 = run_variant(study, nullptr, 0, {0}), at_1 = run_variant(study, nullptr, 1, {1});
  EXPECT_EQ(at_0.status, VariantStatus::failed);
  EXPECT_EQ(at_0.reason, "the quantity \"f\" has no derivative by \"x\" here");
  EXPECT_TRUE(at_0.gradient.empty());
  ASSERT_EQ(at_1.status, VariantStatus::done);
  EXPECT_NEAR(at_1.gradient[0][0], 0.5, 1e-8);
}

// A modulus and a radius: numbers of 1e11 and of 0.01.
TEST(Optimum, IsFoundWhateverTheUnitsAndWithinTheRanges) {
  for (const char* method : {"cobyla", "nelder_mead", "gradient", "genetic"}) {
    const StudyFile study = study_of(R"json({"nurbeam_study": 1,
      "variables": [{"name": "E", "range": [1e11, 3e11]}, {"name": "r", "range": [0.005, 0.02]}],
      "quantities": [{"name": "f", "value": "(E / 1e11 - 1.2)^2 + (100 * r - 0.5)^2"}],
      "optimise": {"minimise": "f", "evaluations": 400, "tolerance": 1e-7, "method": ")json" +
                                     std::string(method) + "\"}}");
    const StudyEvaluation within = [&](const StudyPoints& points) {
      for (const std::vector<double>& point : points) {
        EXPECT_TRUE(point[0] >= 1e11 && point[0] <= 3e11) << method << " " << point[0];
        EXPECT_TRUE(point[1] >= 0.005 && point[1] <= 0.02) << method << " " << point[1];
      }
      return evaluated(study, points);
    };
    const OptimumResult result = find_optimum(study, std::get<StudyOptimum>(study.task), within);
    const double tolerance = std::string(method) == "genetic" ? 0.1 : 1e-3;
    EXPECT_NEAR(result.points[0][0] / 1e11, 1.2, tolerance) << method;
    EXPECT_NEAR(100 * result.points[0][1], 0.5, tolerance) << method;
  }
}

// The square root is no number below 0.2.
TEST(Optimum, IsFoundBesideVariantsThatFail) {
  for (const char* method : {"cobyla", "nelder_mead"}) {
    const StudyFile study = study_of(R"json({"nurbeam_study": 1,
      "variables": [{"name": "x", "range": [-1, 1], "nominal": 0.8}, {"name": "y", "range": [-1, 1], "nominal": 0.8}],
      "quantities": [{"name": "f", "value": "(x - 0.21)^2 + (y + 0.3)^2 + 0 * sqrt(x - 0.2)"}],
      "optimise": {"minimise": "f", "evaluations": 300, "tolerance": 1e-6, "method": ")json" +
                                     std::string(method) + "\"}}");
    const OptimumResult result =
        find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study));
    EXPECT_NEAR(result.points[0][0], 0.21, 1e-2) << method;
    EXPECT_NEAR(result.points[0][1], -0.3, 1e-2) << method;
  }
}

TEST(Optimum, GoesOnAsAnInterruptToItsCaller) {
  const StudyFile study = study_of(ishigami_head + R"json("optimise": {"minimise": "y"}})json");
  int calls = 0;
  const StudyEvaluation interrupted = [&](const StudyPoints& points) {
    if (++calls > 5) throw StudyInterrupted{};
    return evaluated(study, points);
  };
  EXPECT_THROW(find_optimum(study, std::get<StudyOptimum>(study.task), interrupted), StudyInterrupted);
  EXPECT_EQ(calls, 6);
}

TEST(Optimum, OfTwoObjectivesIsAFrontThatNoVariantBeats) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "x", "range": [-1, 3]}],
    "quantities": [{"name": "f", "value": "x^2"}, {"name": "g", "value": "(x - 2)^2"}],
    "optimise": {"minimise": ["f", "g"], "evaluations": 400}})json");
  const OptimumResult result = find_optimum(study, std::get<StudyOptimum>(study.task), evaluation_of(study));
  EXPECT_GE(result.points.size(), 10U);
  for (const auto& point : result.points) {
    EXPECT_GE(point[0], -0.05);  // the front is x in [0, 2]
    EXPECT_LE(point[0], 2.05);
  }
}

}  // namespace
}  // namespace nurbeam
