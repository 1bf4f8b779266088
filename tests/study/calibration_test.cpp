#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "pipelines/study/analysis.h"
#include "pipelines/study/variant.h"
#include "tests/study/study_of_case.h"
#include "tests/study/study_text.h"

namespace nurbeam {
namespace {

using test::study_of;
using test::wrong_with;

constexpr int times = 20;
double time_of(int i) { return 0.1 * (i + 1); }

// A study of `tip.x` with two variables, a in [0, 4] and b in [0, 2e-3]; what was measured of it is
// `measured`.
std::string two_variables(const std::string& a, const std::string& b, const std::vector<double>& measured,
                          const std::string& sd = "0.1") {
  std::ostringstream rows;
  rows.precision(17);
  for (std::size_t i = 0; i < measured.size(); ++i)
    rows << (i > 0 ? ", [" : "[") << time_of(static_cast<int>(i)) << ", " << measured[i] << "]";
  return R"json({"nurbeam_study": 1, "case": "c.json",
    "variables": [{"name": "a", "path": "gravity[0]", )json" +
         a + R"json(}, {"name": "b", "path": "gravity[1]", )json" + b + R"json(}],
    "calibrate": {"observations": [{"value": "tip.x", "measured": [)json" +
         rows.str() + R"json(], "sd": )json" + sd + "}]}}";
}
const std::string ranges[] = {R"("range": [0, 4])", R"("range": [0, 2e-3])"};

CalibrationResult calibrated(const StudyFile& study, double (*model)(double a, double b, double t),
                             const StudyDerivatives& derivatives = {}) {
  const StudyEvaluation evaluate = [&](const StudyPoints& points) {
    StudyPoints quantities;
    for (const auto& point : points) {
      quantities.emplace_back();
      for (int i = 0; i < times; ++i) quantities.back().push_back(model(point[0], point[1], time_of(i)));
    }
    return quantities;
  };
  return calibrate(study, std::get<StudyCalibration>(study.task), evaluate, derivatives);
}

double line(double a, double b, double t) { return a + 1e3 * b * t; }
double decay(double a, double b, double t) { return a * std::exp(-1e3 * b * t); }

std::vector<double> noisy(double (*model)(double, double, double), double a, double b, double sd,
                          std::mt19937& generator) {
  std::normal_distribution<double> noise(0, sd);
  std::vector<double> measured;
  for (int i = 0; i < times; ++i) measured.push_back(model(a, b, time_of(i)) + noise(generator));
  return measured;
}

// The normal equations, and s^2 (X^T X)^-1 with s^2 = sum r^2 / (n - 2).
TEST(Calibration, OfALineIsThatOfTheTextbooks) {
  std::mt19937 generator(4);
  const std::vector<double> measured = noisy(line, 1.5, 0.8e-3, 0.1, generator);
  const CalibrationResult result = calibrated(study_of(two_variables(ranges[0], ranges[1], measured)), line);
  Eigen::MatrixX2d x(times, 2);
  Eigen::VectorXd y(times);
  for (int i = 0; i < times; ++i) {
    x.row(i) << 1, 1e3 * time_of(i);
    y[i] = measured[static_cast<std::size_t>(i)];
  }
  const Eigen::Matrix2d inverse = (x.transpose() * x).inverse();
  const Eigen::Vector2d expected = inverse * x.transpose() * y;
  const double squares = (y - x * expected).squaredNorm();
  EXPECT_NEAR(result.point[0], expected[0], 1e-7);
  EXPECT_NEAR(result.point[1], expected[1], 1e-10);
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) {
      const double covariance = inverse(i, k) * squares / (times - 2);
      EXPECT_NEAR(result.covariance[i][k], covariance, 1e-5 * std::abs(covariance)) << i << k;
    }
  EXPECT_NEAR(result.noise, std::sqrt(squares / (times - 2)) / 0.1, 1e-7);
  EXPECT_EQ(result.degrees_of_freedom, times - 2);
  for (int i = 0; i < 2; ++i)  // Student's quantile of 97.5 % with 18 degrees of freedom
    EXPECT_NEAR(result.upper[i], result.point[i] + 2.1009220402 * result.sd[i], 1e-9 * result.sd[i]);
  EXPECT_LE(result.evaluations, 30);
}

// A study in which `constraint` holds besides.
std::string within(const std::string& constraint, const std::string& study) {
  std::string text = study;
  return text.insert(text.find("\"variables\""), "\"constraints\": [\"" + constraint + "\"], ");
}

/// As calibrated(), of variants among which those that do not hold `allows` are rejected.
CalibrationResult calibrated_within(const StudyFile& study, double (*model)(double, double, double),
                                    bool (*allows)(double, double)) {
  const StudyEvaluation evaluate = [&](const StudyPoints& points) {
    StudyPoints quantities;
    for (const auto& point : points) {
      quantities.emplace_back();
      for (int i = 0; i < times && allows(point[0], point[1]); ++i)
        quantities.back().push_back(model(point[0], point[1], time_of(i)));
    }
    return quantities;
  };
  return calibrate(study, std::get<StudyCalibration>(study.task), evaluate);
}

// The search passes beyond the constraint, behind which the optimum does not lie.
TEST(Calibration, WithinConstraintsIsThatWithoutThem) {
  std::mt19937 generator(4);
  const std::vector<double> measured = noisy(decay, 2, 0.7e-3, 0.02, generator);
  const std::string study = two_variables(ranges[0] + R"(, "nominal": 0.2)", ranges[1], measured);
  const auto allows = [](double a, double b) { return 1e3 * b < 0.72 && a * a + 1e6 * b * b < 4.6; };
  const CalibrationResult free = calibrated(study_of(study), decay);
  const CalibrationResult held =
      calibrated_within(study_of(within(R"(1e3 * b < 0.72", "a^2 + 1e6 * b^2 < 4.6)", study)), decay, allows);
  ASSERT_TRUE(held.active.empty());
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(held.point[i], free.point[i], 1e-5 * free.point[i]);
    EXPECT_NEAR(held.sd[i], free.sd[i], 1e-3 * free.sd[i]);
  }
}

// With a = 1.2, b is that of a line through (0, 1.2).
TEST(Calibration, AtTheEdgeOfAConstraintIsTheLeastThereAndHasNoIntervals) {
  std::mt19937 generator(4);
  const std::vector<double> measured = noisy(line, 1.5, 0.8e-3, 0.1, generator);
  const StudyFile study =
      study_of(within("a <= 1.2", two_variables(ranges[0] + R"(, "nominal": 0.5)", ranges[1], measured)));
  const CalibrationResult result = calibrated_within(study, line, [](double a, double) { return a <= 1.2; });
  double products = 0, squares = 0;
  for (int i = 0; i < times; ++i) {
    products += time_of(i) * (measured[static_cast<std::size_t>(i)] - 1.2);
    squares += time_of(i) * time_of(i);
  }
  EXPECT_NEAR(result.point[0], 1.2, 1e-6);
  EXPECT_NEAR(result.point[1], 1e-3 * products / squares, 1e-8);
  EXPECT_EQ(result.active, std::vector<std::string>{"a <= 1.2"});
  EXPECT_TRUE(result.sd.empty() && result.lower.empty() && result.covariance.empty());
}

TEST(Calibration, TakesNoConstraintOfWhichItDoesNotKnowHowFarItIs) {
  const std::string wrong = wrong_with(
      within("(a < 1) * (b < 1)", two_variables(ranges[0], ranges[1], std::vector<double>(times, 1.0))));
  EXPECT_NE(wrong.find("constraints[0]: \"(a < 1) * (b < 1)\" is no comparison"), std::string::npos) << wrong;
}

TEST(Calibration, TakesTheDerivativesThatVariantsHave) {
  std::mt19937 generator(4);
  const std::vector<double> measured = noisy(decay, 2, 0.7e-3, 0.02, generator);
  const StudyFile study = study_of(two_variables(ranges[0], ranges[1], measured));
  EXPECT_TRUE(study.derivatives && study.derivatives_where_known);
  const StudyDerivatives known = [](const std::vector<double>& point) {
    StudyGradient gradient;
    for (int i = 0; i < times; ++i) {
      const double t = time_of(i), part = std::exp(-1e3 * point[1] * t);
      gradient.push_back({part, -1e3 * t * point[0] * part});
    }
    return gradient;
  };
  const StudyDerivatives none = [](const std::vector<double>&) { return StudyGradient{}; };
  const CalibrationResult with = calibrated(study, decay, known), without = calibrated(study, decay, none);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(with.point[i], without.point[i], 1e-6 * without.point[i]);
    for (int k = 0; k < 2; ++k)
      EXPECT_NEAR(with.covariance[i][k], without.covariance[i][k], 1e-4 * std::abs(without.covariance[i][k]));
  }
  EXPECT_LT(2 * with.evaluations, without.evaluations);
}

// Of 200 measurements nineteen in twenty leave the true values inside the region: the deviation of that
// is 1.5 %.
TEST(Calibration, RegionHoldsTheTruthAsOftenAsItSays) {
  std::mt19937 generator(7);
  int inside = 0;
  constexpr int trials = 200;
  for (int trial = 0; trial < trials; ++trial) {
    const auto measured = noisy(decay, 2, 0.7e-3, 0.02, generator);
    const CalibrationResult result =
        calibrated(study_of(two_variables(ranges[0], ranges[1], measured)), decay);
    Eigen::Matrix2d covariance;
    covariance << result.covariance[0][0], result.covariance[0][1], result.covariance[1][0],
        result.covariance[1][1];
    const Eigen::Vector2d off(result.point[0] - 2, result.point[1] - 0.7e-3);
    inside += off.dot(covariance.inverse() * off) < -2 * std::log(0.05) ? 1 : 0;
  }
  EXPECT_GE(inside, trials * 0.88);
  EXPECT_LE(inside, trials * 0.99);
}

// A mean of known variance with a normal prior: the variances' inverses add.
TEST(Calibration, WithWhatIsKnownBeforeWeighsBoth) {
  const std::vector<double> measured(times, 1.0);
  const std::string a = R"("distribution": {"normal": {"mean": 2, "sd": 0.05}})";
  const std::string b = R"("distribution": {"normal": {"mean": 0, "sd": 1e-3}})";
  const auto level = [](double x, double y, double) { return x + 0 * y; };
  const CalibrationResult result = calibrated(study_of(two_variables(a, b, measured, "0.2")), level);
  const double of_data = times / (0.2 * 0.2), of_prior = 1 / (0.05 * 0.05);
  EXPECT_NEAR(result.point[0], (of_data * 1 + of_prior * 2) / (of_data + of_prior), 1e-6);
  EXPECT_NEAR(result.sd[0], 1 / std::sqrt(of_data + of_prior), 1e-6);
  EXPECT_NEAR(result.sd[1], 1e-3, 1e-8) << "of which the measurements say nothing";
  EXPECT_NEAR(result.lower[0], result.point[0] - 1.959964 * result.sd[0], 1e-6);
  EXPECT_NEAR(result.upper[0], result.point[0] + 1.959964 * result.sd[0], 1e-6);
}

TEST(Calibration, OfWhatMeasurementsDoNotDetermineSaysSo) {
  std::mt19937 generator(4);
  const auto measured = noisy(line, 1.5, 0.8e-3, 0.1, generator);
  const auto sum = [](double a, double b, double) { return a + 1e3 * b; };
  EXPECT_THROW(calibrated(study_of(two_variables(ranges[0], ranges[1], measured)), sum), std::runtime_error);
}

// A calibration of three variables against what a model says of 1.7, 1.2 and 0.6; what it says of the answer.
std::string told_of(double (*model)(double a, double b, double c, double t), const std::string& evaluations,
                    bool with_derivatives) {
  std::ostringstream rows;
  rows.precision(17);
  for (int i = 0; i < times; ++i)
    rows << (i > 0 ? ", [" : "[") << time_of(i) << ", " << model(1.7, 1.2, 0.6, time_of(i)) << "]";
  const StudyFile study = study_of(
      R"json({"nurbeam_study": 1, "case": "c.json",
    "variables": [{"name": "a", "path": "gravity[0]", "range": [1, 3]}, {"name": "b", "path": "gravity[1]", "range": [1, 3]},
                  {"name": "c", "path": "gravity[2]", "range": [0, 1]}],
    "calibrate": {"evaluations": )json" +
      evaluations + R"json(, "observations": [{"value": "tip.x", "measured": [)json" + rows.str() + "]}]}}");
  const auto run = [&](const std::vector<double>& p) {
    std::vector<double> history;
    for (int i = 0; i < times; ++i) history.push_back(model(p[0], p[1], p[2], time_of(i)));
    return history;
  };
  const StudyEvaluation evaluate = [&](const StudyPoints& points) {
    StudyPoints quantities;
    for (const auto& point : points) quantities.push_back(run(point));
    return quantities;
  };
  const StudyDerivatives derivatives = [&](const std::vector<double>& point) {
    StudyGradient gradient(times, std::vector<double>(3));
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr double h = 1e-5;
      std::vector<double> more = point, less = point;
      more[k] += h;
      less[k] -= h;
      const std::vector<double> above = run(more), below = run(less);
      for (std::size_t i = 0; i < above.size(); ++i) gradient[i][k] = (above[i] - below[i]) / (2 * h);
    }
    return gradient;
  };
  try {
    const CalibrationResult result = calibrate(study, std::get<StudyCalibration>(study.task), evaluate,
                                               with_derivatives ? derivatives : StudyDerivatives());
    EXPECT_NEAR(result.point[0], 1.7, 1e-6);
    EXPECT_NEAR(result.point[1], 1.2, 1e-6);
    EXPECT_NEAR(result.point[2], 0.6, 1e-6);
    return "";
  } catch (const std::runtime_error& problem) {
    return problem.what();
  }
}

// Without noise what is left of the squares says nothing of it.
TEST(Calibration, NamesTheVariablesThatMeasurementsDoNotTellApart) {
  const std::string apart =
      " apart: what one of them does to the runs others undo; give one of them a fixed value, or measure what they "
      "change in different ways";
  for (const bool with_derivatives : {true, false})
    for (const char* evaluations : {"9", "200"}) {
      EXPECT_EQ(told_of([](double a, double b, double c, double t) { return a * b * std::exp(-c * t); },
                        evaluations, with_derivatives),
                "the measurements do not tell \"a\" and \"b\"" + apart);
      EXPECT_EQ(told_of([](double a, double b, double c, double t) { return (a - 2 * b + 3 * c) * t; },
                        evaluations, with_derivatives),
                "the measurements do not tell \"a\", \"b\" and \"c\"" + apart);
      EXPECT_EQ(told_of([](double a, double, double c, double t) { return a * std::exp(-c * t); },
                        evaluations, with_derivatives),
                "the measurements do not change with \"b\": leave it out, or measure what it changes");
    }
}

// Columns that differ by a hundredth are told apart by what is exact.
TEST(Calibration, LeavesVariablesAloneThatAreNearlyAlike) {
  for (const bool with_derivatives : {true, false})
    EXPECT_EQ(told_of([](double a, double b, double c,
                         double t) { return a * t + b * (t + 1e-2 * t * t) + std::exp(-c * t); },
                      "200", with_derivatives),
              "");
}

TEST(Calibration, NeedsRangesOrNormalDistributionsAndEnoughValues) {
  const std::vector<double> measured(times, 1.0);
  const std::string normal = R"("distribution": {"normal": {"mean": 2, "sd": 0.05}})";
  EXPECT_NE(wrong_with(two_variables(ranges[0], normal, measured)).find("calibrate: needs a \"range\""),
            std::string::npos);
  EXPECT_NE(wrong_with(two_variables(ranges[0], ranges[1], {1, 2}))
                .find("calibrate.observations: has 2 values for 2 variables"),
            std::string::npos);
  EXPECT_EQ(wrong_with(two_variables(normal, normal, measured)), "");
}

TEST(Calibration, RefusesWhatWasMeasuredAfterTheEndOfTheRun) {
  const auto told = [](const std::string& last) {
    const test::StudyOfCase of(
        test::spline_case(6, 4, R"json({"end_time": 0.4, "step": 0.01})json"),
        R"json("variables": [{"name": "E", "path": "beams[0].material.youngs_modulus", "range": [1e9, 3e9]}],
          "calibrate": {"observations": [{"value": "tip.z", "measured": [[0.1, 0], [)json" +
            last + R"json(, 0]]}]})json");
    std::string all;
    for (const Diagnostic& d : check_quantities(of.study, &of.study_case))
      all += d.where + ": " + d.message + "\n";
    return all;
  };
  EXPECT_EQ(told("0.4"), "");
  EXPECT_EQ(told("0.40000000000000002"), "");
  EXPECT_EQ(told("0.40000000000000008"), "") << "one digit behind the end";
  EXPECT_NE(
      told("0.5").find(
          "study.json: calibrate.observations[0].measured: a run of this case goes from 0 s to 0.4 s, and 0.5 s "
          "is not between; give a longer \"analysis.end_time\" that reaches it, or leave out what was "
          "measured there"),
      std::string::npos)
      << told("0.5");
}

}  // namespace
}  // namespace nurbeam
