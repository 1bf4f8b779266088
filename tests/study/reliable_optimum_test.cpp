#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/study/analysis.h"
#include "pipelines/study/variant.h"
#include "tests/study/study_text.h"

namespace nurbeam {
namespace {

using test::study_of;
using test::wrong_with;

/// Runs variants of a study without a case in this process, and counts them.
struct Variants {
  const StudyFile& study;
  int count = 0;

  StudyEvaluation evaluation() {
    return [this](const StudyPoints& points) {
      StudyPoints quantities;
      for (const std::vector<double>& point : points)
        quantities.push_back(run_variant(study, nullptr, 0, all_values(study, point)).quantities);
      count += static_cast<int>(points.size());
      return quantities;
    };
  }
  StudyDerivatives derivatives() {
    if (!study.derivatives) return {};
    return [this](const std::vector<double>& point) {
      return run_variant(study, nullptr, 0, all_values(study, point)).gradient;
    };
  }
};

OptimumResult optimum_of(const StudyFile& study, int* count = nullptr) {
  Variants variants{study};
  OptimumResult result = find_reliable_optimum(study, std::get<StudyOptimum>(study.task),
                                               variants.evaluation(), variants.derivatives());
  if (count) *count = variants.count;
  return result;
}

/// Of a probability: the text as a user writes it.
std::string optimise(const std::string& constraint, const std::string& more = "") {
  return R"json("optimise": {"minimise": "cost", "subject_to": [")json" + constraint + "\"]" + more +
         R"json(, "tolerance": 1e-8}})json";
}

const std::string strength_head = R"json({"nurbeam_study": 1,
  "variables": [{"name": "r", "range": [5, 40]},
                {"name": "R", "distribution": {"normal": {"mean": "r", "sd": 2}}},
                {"name": "S", "distribution": {"normal": {"mean": 10, "sd": 1.5}}}],
  "quantities": [{"name": "cost", "value": "r + 0 * (R + S)"}, {"name": "margin", "value": "R - S"}], )json";

constexpr double index_of_one_in_thousand = 3.090232306167813;

// R - S is normal: the mean of R is that of S, and the index times the deviation of the difference.
TEST(ReliableOptimum, OfALinearLimitOfNormalVariablesIsExact) {
  const double exact = 10 + index_of_one_in_thousand * 2.5;
  for (const char* constraint :
       {"probability(R < S) <= 1e-3", "probability(S > R) <= 1e-3", "probability(R >= S) >= 0.999",
        "reliability_index(margin < 0) >= 3.090232306167813", "probability(0 > margin) < 1e-3"})
    for (const char* more : {"", R"(, "derivatives": "differences")", R"(, "method": "cobyla")"}) {
      const StudyFile study = study_of(strength_head + optimise(constraint, more));
      const OptimumResult result = optimum_of(study);
      EXPECT_NEAR(result.points.front()[0], exact, 1e-5) << constraint << more;
      EXPECT_EQ(result.points.front()[1], result.points.front()[0]) << "R stands at its mean";
      ASSERT_EQ(result.probabilities.size(), 1U);
      EXPECT_NEAR(*result.probabilities[0].form.reliability_index, index_of_one_in_thousand, 1e-5);
      EXPECT_NEAR(result.probabilities[0].form.probability, 1e-3, 1e-7);
      EXPECT_TRUE(result.doubts.empty()) << result.doubts.front();
      EXPECT_EQ(result.quantities.front().size(), 2U);
      // db/dr = 1 / 2.5, and at the design point R and S are the same.
      ASSERT_EQ(result.probabilities[0].index_gradient.size(), 1U);
      EXPECT_NEAR(result.probabilities[0].index_gradient[0], 0.4, 1e-6);
      EXPECT_NEAR(result.probabilities[0].form.design_point[1], result.probabilities[0].form.design_point[2],
                  1e-4);
      EXPECT_NEAR(result.probabilities[0].form.importance[0], 4 / 6.25, 1e-6);
    }
}

// F and s are scattered, the area a is not: a s - F is normal. A quadratic equation for a.
TEST(ReliableOptimum, HasDesignVariablesThatAreNotScattered) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "a", "range": [1e-5, 1e-3]},
                  {"name": "F", "distribution": {"normal": {"mean": 20000, "sd": 3000}}},
                  {"name": "s", "distribution": {"normal": {"mean": 250e6, "sd": 15e6}}}],
    "quantities": [{"name": "cost", "value": "1e6 * a"}, {"name": "stress", "value": "F / a"}], )json" +
                                   optimise("reliability_index(stress > s) >= 3"));
  const double m = 250e6, d = 15e6, f = 20000, e = 3000, b2 = 9;
  const double A = m * m - b2 * d * d, B = -2 * m * f, C = f * f - b2 * e * e;
  const double exact = (-B + std::sqrt(B * B - 4 * A * C)) / (2 * A);
  int count = 0;
  const OptimumResult result = optimum_of(study, &count);
  EXPECT_NEAR(result.points.front()[0] / exact, 1, 1e-6);
  EXPECT_LE(count, 120);
  // b = (a m - f) / sqrt(a^2 d^2 + e^2).
  const double n = std::hypot(exact * d, e), by_a = m / n - (exact * m - f) * exact * d * d / (n * n * n);
  EXPECT_NEAR(result.probabilities[0].index_gradient[0] / by_a, 1, 1e-4);
}

// Of a product the logarithm is a sum, normal where the factors are lognormal: also a deviation may be made
// by the design. P(F > R t^2) with t lognormal of mean d and sd d / 20.
TEST(ReliableOptimum, OfAProductOfLognormalVariablesIsExact) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "d", "range": [0.5, 6]},
                  {"name": "t", "distribution": {"lognormal": {"mean": "d", "sd": "d / 20"}}},
                  {"name": "F", "distribution": {"lognormal": {"mean": 10, "sd": 2}}},
                  {"name": "R", "distribution": {"lognormal": {"mean": 5, "sd": 0.4}}}],
    "quantities": [{"name": "cost", "value": "t^2"}, {"name": "use", "value": "F / (R * t^2)"}], )json" +
                                   optimise("probability(use > 1) <= 1e-4"));
  const auto log_sd2 = [](double variation) { return std::log1p(variation * variation); };
  const double st = log_sd2(0.05), sf = log_sd2(0.2), sr = log_sd2(0.08), index = 3.719016485455709;
  // ln R + 2 ln t - ln F.
  const double sd = std::sqrt(sr + 4 * st + sf);
  const double log_d = 0.5 * (index * sd - (std::log(5.0) - sr / 2) + (std::log(10.0) - sf / 2)) + st / 2;
  const OptimumResult result = optimum_of(study);
  EXPECT_NEAR(result.points.front()[0] / std::exp(log_d), 1, 1e-6);
  EXPECT_NEAR(*result.probabilities[0].form.reliability_index, index, 1e-5);
  EXPECT_NEAR(result.probabilities[0].index_gradient[0] * std::exp(log_d) * sd / 2, 1, 1e-5);
}

// One variable: the design is its quantile, whatever its distribution.
TEST(ReliableOptimum, OfOneVariableIsItsQuantile) {
  const double p = 1e-2, sd = 3, scale = sd * std::sqrt(6.0) / std::numbers::pi,
               mode = 20 - std::numbers::egamma * scale;
  const struct {
    const char* distribution;
    double quantile;
  } known[] = {{R"json("gumbel": {"mean": 20, "sd": 3})json", mode - scale * std::log(-std::log(1 - p))},
               {R"json("uniform": [10, 30])json", 30 - 20 * p},
               {R"json("normal": {"mean": 20, "sd": 3}, "lower": 20)json", 20 + 3 * 2.5758293035489},
               {R"json("triangular": [10, 12, 30])json", 30 - std::sqrt(p * 20 * 18)}};
  for (const auto& [distribution, quantile] : known) {
    const StudyFile study = study_of(
        R"json({"nurbeam_study": 1, "variables": [{"name": "h", "range": [5, 60]},
      {"name": "Q", "distribution": {)json" +
        std::string(distribution) + R"json(}}], "quantities": [{"name": "cost", "value": "h"}], )json" +
        optimise("probability(Q > h) <= 0.01"));
    EXPECT_NEAR(optimum_of(study).points.front()[0], quantile, 1e-5) << distribution;
  }
}

// Youn and Choi's problem (J. Mech. Des. 126, 2004, 403): the optimum is (3.4391, 3.2864), of cost 6.7257.
TEST(ReliableOptimum, IsThatOfTheLiterature) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "a", "range": [0, 10], "nominal": 5}, {"name": "b", "range": [0, 10], "nominal": 5},
                  {"name": "x", "distribution": {"normal": {"mean": "a", "sd": 0.3}}},
                  {"name": "y", "distribution": {"normal": {"mean": "b", "sd": 0.3}}}],
    "quantities": [{"name": "cost", "value": "x + y"}, {"name": "g1", "value": "x^2 * y / 20 - 1"},
      {"name": "g2", "value": "(x + y - 5)^2 / 30 + (x - y - 12)^2 / 120 - 1"},
      {"name": "g3", "value": "80 / (x^2 + 8 * y + 5) - 1"}],
    "optimise": {"minimise": "cost", "tolerance": 1e-7, "subject_to": ["reliability_index(g1 < 0) >= 3",
      "reliability_index(g2 < 0) >= 3", "reliability_index(g3 < 0) >= 3"]}})json");
  int count = 0;
  const OptimumResult result = optimum_of(study, &count);
  EXPECT_NEAR(result.points.front()[0], 3.4391, 2e-3);
  EXPECT_NEAR(result.points.front()[1], 3.2866, 2e-3);
  EXPECT_NEAR(result.quantities.front()[0], 6.7257, 1e-3);
  EXPECT_NEAR(*result.probabilities[0].form.reliability_index, 3, 1e-4);
  EXPECT_NEAR(*result.probabilities[1].form.reliability_index, 3, 1e-4);
  EXPECT_GT(*result.probabilities[2].form.reliability_index, 3.1);
  EXPECT_LE(count, 300);
  EXPECT_TRUE(std::is_sorted(
      result.history.rbegin(),
      std::find_if(result.history.rbegin(), result.history.rend(), [](double v) { return std::isnan(v); })));
}

// Against FORM at neighbours of the design: a Gumbel load, a bent limit, a mean and a deviation that the
// design makes.
TEST(ReliableOptimum, HasTheGradientThatDifferencesTendTo) {
  const std::string variables = R"json({"nurbeam_study": 1, "variables": [)json",
                    quantities = R"json("quantities": [{"name": "cost", "value": "m + t"},
                      {"name": "g", "value": "x^1.5 * y - q * t^0.2 - 0.3 * y^2"}], )json";
  const StudyFile study = study_of(variables + R"json(
    {"name": "m", "range": [2, 12], "nominal": 6}, {"name": "t", "range": [1, 3], "nominal": 2},
    {"name": "x", "distribution": {"lognormal": {"mean": "m", "sd": "0.1 * m / t"}}},
    {"name": "y", "distribution": {"normal": {"mean": 4, "sd": 0.3}}},
    {"name": "q", "distribution": {"gumbel": {"mean": 20, "sd": "2 + 0.2 * t"}}}], )json" +
                                   quantities + optimise("probability(g < 0) <= 1e-3"));
  const OptimumResult result = optimum_of(study);
  const double m = result.points.front()[0], t = result.points.front()[1];
  const auto index_at = [&](double mean, double way) {
    const auto digits = [](double v) {
      char buffer[40];
      std::snprintf(buffer, sizeof buffer, "%.15g", v);
      return std::string(buffer);
    };
    const StudyFile plain = study_of(
        variables +
        R"json({"name": "t", "range": [0, 9]}, {"name": "x", "distribution": {"lognormal": {"mean": )json" +
        digits(mean) + R"json(, "sd": )json" + digits(0.1 * mean / way) +
        R"json(}}}, {"name": "y", "distribution": {"normal": {"mean": 4, "sd": 0.3}}},
        {"name": "q", "distribution": {"gumbel": {"mean": 20, "sd": )json" +
        digits(2 + 0.2 * way) + R"json(}}}], "quantities": [{"name": "g", "value": "x^1.5 * y - q * )json" +
        digits(way) +
        R"json(^0.2 - 0.3 * y^2 + 0 * t"}],
        "reliability": {"quantity": "g", "below": 0}})json");
    Variants variants{plain};
    return *failure_probability(plain, std::get<StudyReliability>(plain.task), variants.evaluation(),
                                variants.derivatives())
                .reliability_index;
  };
  EXPECT_NEAR(index_at(m, t), *result.probabilities[0].form.reliability_index, 1e-5);
  const double h = 0.02;  // FORM ends a millionth away
  const double by_m = (index_at(m + h, t) - index_at(m - h, t)) / (2 * h),
               by_t = (index_at(m, t + h) - index_at(m, t - h)) / (2 * h);
  EXPECT_NEAR(result.probabilities[0].index_gradient[0], by_m, 1e-4 * std::abs(by_m) + 1e-5);
  EXPECT_NEAR(result.probabilities[0].index_gradient[1], by_t, 1e-4 * std::abs(by_t) + 1e-5);
}

TEST(ReliableOptimum, IsCheckedBySimulation) {
  for (const char* check :
       {R"(, "check": {"count": 4000})", R"(, "check": {"method": "monte_carlo", "count": 40000})"}) {
    const StudyFile study = study_of(strength_head + optimise("probability(R < S) <= 1e-2", check));
    const OptimumResult result = optimum_of(study);
    ASSERT_TRUE(result.probabilities[0].check);
    const ReliabilityResult& found = *result.probabilities[0].check;
    EXPECT_NEAR(found.probability, 1e-2, 4 * found.probability * *found.coefficient_of_variation) << check;
    EXPECT_NEAR(result.probabilities[0].form.probability, 1e-2, 1e-6) << check;
    EXPECT_TRUE(result.doubts.empty()) << check;
  }
}

// Failure outside of a circle about the origin: its probability is exp(-r^2 / 2), five times FORM's at r
// = 2.3.
TEST(ReliableOptimum, SaysThatABentLimitIsPassedMoreOften) {
  const StudyFile study = study_of(
      R"json({"nurbeam_study": 1,
    "variables": [{"name": "r", "range": [1, 6]}, {"name": "x", "distribution": {"normal": {"mean": 0.01, "sd": 1}}},
                  {"name": "y", "distribution": {"normal": {"mean": 0.02, "sd": 1}}}],
    "quantities": [{"name": "cost", "value": "r"}, {"name": "away", "value": "x^2 + y^2"}], )json" +
      optimise("probability(away > r^2) <= 1e-2", R"(, "check": {"method": "monte_carlo", "count": 20000})"));
  const OptimumResult result = optimum_of(study);
  EXPECT_NEAR(result.probabilities[0].check->probability, std::exp(-0.5 * 2.3263 * 2.3263), 0.01);
  ASSERT_EQ(result.doubts.size(), 1U);
  EXPECT_NE(result.doubts[0].find("above the 0.01 that FORM holds"), std::string::npos) << result.doubts[0];
  EXPECT_NE(result.doubts[0].find("reliability_index(...) >= "), std::string::npos);
}

TEST(ReliableOptimum, SaysThatNoDesignHoldsTheProbability) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1,
    "variables": [{"name": "h", "range": [1, 2]}, {"name": "q", "distribution": {"normal": {"mean": 5, "sd": 1}}}],
    "quantities": [{"name": "cost", "value": "h"}], )json" +
                                   optimise("probability(q > h) <= 1e-3"));
  try {
    optimum_of(study);
    FAIL();
  } catch (const std::runtime_error& problem) {
    EXPECT_NE(std::string(problem.what()).find("\"probability(q > h) <= 1e-3\" is missed by 6.09"),
              std::string::npos)
        << problem.what();
  }
}

TEST(ReliableOptimum, RefusesWhatIsNoProbability) {
  const auto wrong = [](const std::string& constraint, const std::string& more = "") {
    return wrong_with(strength_head + optimise(constraint, more));
  };
  const struct {
    std::string found, said;
  } cases[] = {
      {wrong("probability(R) <= 1e-3"),
       "optimise.subject_to[0]: \"R\" is no comparison, which may hold or not; write it as \"probability(stress > 2.5e8) <= 1e-3\""},
      {wrong("probability(R < T) <= 1e-3"), "optimise.subject_to[0]: there is no quantity or variable \"T\""},
      {wrong("probability(R < S) <= r"), "optimise.subject_to[0]: \" r\" is no number"},
      {wrong("probability(R < S) >= 1e-3"),
       "is a probability >= 0.001; the number must be from 0.5 to 1 - 1e-12, or take \"<=\""},
      {wrong("probability(R < S) <= 0.9"),
       "is a probability <= 0.9; the number must be from 1e-12 to 0.5, or take \">=\""},
      {wrong("probability(R < S) <= 0"), "must be from 1e-12 to 0.5"},
      {wrong("reliability_index(R < S) <= 3"), "asks for a reliability index that is small; take \">=\""},
      {wrong("reliability_index(R < S) >= 30"), "is a reliability index of 30; must be from 0 to 7"},
      {wrong("2 * probability(R < S) <= 1e-3"), "is no limit of a probability; write it as"},
      {wrong("probability(R < S <= 1e-3"), "is no limit of a probability; write it as"},
      {wrong("r < 30", R"(, "check": {})"),
       "optimise.check: has no use: nothing in \"subject_to\" is a \"probability(...)\""},
      {wrong_with(strength_head + R"json("plan": {"monte_carlo": {"count": 3}}})json"),
       "variables[1].distribution: names other variables (\"r\"), which only \"optimise\" with a "
       "\"probability(...)\""},
      {wrong("probability(R < S) <= 1e-3", R"(, "method": "nelder_mead")"),
       "is \"nelder_mead\", which knows no \"subject_to\""},
      {wrong("probability(R < S) <= 1e-3", R"(, "maximise": "margin")"),
       "names several quantities, but with a probability"}};
  for (const auto& [found, said] : cases)
    EXPECT_NE(found.find(said), std::string::npos) << said << "\n" << found;
}

TEST(ReliableOptimum, RefusesDistributionsThatADesignDoesNotMake) {
  const auto wrong = [](const std::string& variables) {
    return wrong_with(R"json({"nurbeam_study": 1, "variables": [)json" + variables +
                      R"json(], "quantities": [{"name": "cost", "value": "0"}], )json" +
                      optimise("probability(x > 1) <= 1e-3"));
  };
  const std::string r = R"json({"name": "r", "range": [0, 2]}, )json";
  const struct {
    std::string found, said;
  } cases[] = {
      {wrong(r + R"json({"name": "x", "distribution": {"normal": {"mean": "rr", "sd": 1}}})json"),
       "variables[1].distribution.normal.mean: there is no earlier variable with a \"range\" \"rr\"; did you mean \"r\"?"},
      {wrong(r + R"json({"name": "x", "distribution": {"normal": {"mean": "r", "sd": "0.1 * r"}}})json"),
       "variables[1].distribution: is none with r = 0: its sd is 0; narrow the \"range\" of \"r\""},
      {wrong(r + R"json({"name": "x", "distribution": {"uniform": ["r", 1.5]}})json"),
       "variables[1].distribution: is none with r = 2: 2 is not below 1.5"},
      {wrong(r +
             R"json({"name": "x", "distribution": {"normal": {"mean": "r", "sd": 1}}, "nominal": 1})json"),
       "variables[1].nominal: is fixed, but the design makes the distribution; leave it out"},
      {wrong(R"json({"name": "x", "distribution": {"normal": {"mean": 1, "sd": 1}}})json"),
       "optimise: has nothing to search: all variables have a \"distribution\""},
      {wrong(R"json({"name": "x", "range": [0, 1]})json"),
       "optimise.subject_to: has a probability, but no variable has a \"distribution\""}};
  for (const auto& [found, said] : cases)
    EXPECT_NE(found.find(said), std::string::npos) << said << "\n" << found;
}

// A design variable that is a mean has the unit of what is scattered about it.
TEST(ReliableOptimum, ReadsUnitsOfMeansAsThoseOfWhatTheyAreOf) {
  const StudyFile study = study_of(R"json({"nurbeam_study": 1, "case": "c.json",
    "variables": [{"name": "mean radius", "range": ["4 mm", "8 mm"]},
                  {"name": "radius", "path": "beams[0].section.radius",
                   "distribution": {"normal": {"mean": "'mean radius'", "sd": "0.1 mm"}, "lower": "1 mm"}}],
    "quantities": [{"name": "v", "value": "max(trolley.speed)"}],
    "optimise": {"minimise": "v", "subject_to": ["probability(v > 3) <= 1e-3"]}})json");
  EXPECT_EQ(study.variables[0].distribution.parameters, (std::vector<double>{0.004, 0.008}));
  EXPECT_EQ(study.variables[0].unit, "m");
  EXPECT_NEAR(study.variables[1].distribution.parameters[0], 0.006, 1e-15);
  EXPECT_NEAR(study.variables[1].nominal, 0.006, 1e-9);
}

}  // namespace
}  // namespace nurbeam
