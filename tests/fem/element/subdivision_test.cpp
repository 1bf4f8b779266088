#include "fem/element/subdivision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "fem/model/beam_model.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

RationalCubic curve_of(const RancfElement& element) {
  return to_bezier(element.e, element.weights, element.l);
}

RancfElement element_of(const RationalCubic& cubic, double l) {
  return {to_rancf(cubic, l), cubic.points().row(3).transpose(), l};
}

RancfElement random_element(Generator& generator) {
  return element_of(random_cubic(generator), std::exp(uniform(generator, -3, 3)));
}

/// The non-uniform arc of [S]: radius 1/2, 60 degrees; slopes and weights as printed.
RancfElement paper_element() {
  RancfElement element;
  element.e << 0, 0.667185831, 0.5 * std::sin(std::numbers::pi / 3), 0.68333751,  //
      0, 0, 0.25, 1.18361,                                                        //
      0, 0, 0, 0;
  element.weights << 1, 1.08621103, 0.98905339, 1;
  element.l = std::numbers::pi / 6;
  return element;
}

double relative_difference(const RationalCubic& a, const RationalCubic& b) {
  return (a.points() - b.points()).norm() / b.points().norm();
}

// ---- Eqs. 3-6 ----

TEST(Subdivision, ASplitIsThatOfDeCasteljau) {
  Generator generator(1);
  for (int i = 0; i < 5000; ++i) {
    const RancfElement element = random_element(generator);
    const double u = uniform(generator, 0.02, 0.98);
    const auto [left, right] = split(element, u);
    const RationalCubic whole = curve_of(element);
    const auto [left_curve, right_curve] = whole.split(u);
    ASSERT_LE(relative_difference(curve_of(left), left_curve), 1e-13) << i;
    ASSERT_LE(relative_difference(curve_of(right), right_curve), 1e-13) << i;
    ASSERT_LE((left.weights - left_curve.points().row(3).transpose()).norm(), 1e-14) << i;
    ASSERT_LE((right.weights - right_curve.points().row(3).transpose()).norm(), 1e-14) << i;
  }
}

TEST(Subdivision, ASplitKeepsPositionAndSlopeEverywhere) {
  Generator generator(2);
  for (int i = 0; i < 2000; ++i) {
    const RancfElement element = random_element(generator);
    const double u = uniform(generator, 0.02, 0.98);
    const auto [left, right] = split(element, u);
    const Eigen::Matrix<double, 3, 6> there = curve_of(element).derivatives(u);
    const double size = 1 + there.col(1).norm() / element.l;
    ASSERT_LE((left.e.col(2) - there.col(0)).norm(), 1e-14);
    ASSERT_LE((left.e.col(3) - there.col(1) / element.l).norm(), 1e-13 * size);
    ASSERT_LE((left.e.col(2) - right.e.col(0)).norm(), 1e-15);
    ASSERT_LE((left.e.col(3) - right.e.col(1)).norm(), 1e-13 * size);
    ASSERT_LE((left.e.leftCols<2>() - element.e.leftCols<2>()).norm(), 1e-14 * element.e.norm());
    ASSERT_LE((right.e.rightCols<2>() - element.e.rightCols<2>()).norm(), 1e-14 * element.e.norm());
    ASSERT_NEAR(left.l + right.l, element.l, 1e-15 * element.l);
    const double t = uniform(generator, 0, 1);
    const Eigen::Vector3d slope = curve_of(element).derivatives(u * t).col(1) / element.l;
    ASSERT_LE((curve_of(left).derivatives(t).col(1) / left.l - slope).norm(), 1e-12 * (1 + slope.norm()));
  }
}

TEST(Subdivision, FarFromTheOriginASplitKeepsTheDigitsOfItsSlopes) {
  Generator generator(3);
  for (int i = 0; i < 500; ++i) {
    RancfElement near = random_element(generator);
    // A grid on which adding 2^20 is exact.
    for (const int k : {0, 2}) near.e.col(k) = (near.e.col(k) * 0x1p24).array().round() * 0x1p-24;
    RancfElement far = near;
    for (const int k : {0, 2}) far.e.col(k).array() += 0x1p20;
    const double u = uniform(generator, 0.02, 0.98);
    ASSERT_EQ(split(far, u).first.e.col(3), split(near, u).first.e.col(3));
    ASSERT_EQ(split(far, u).second.e.col(1), split(near, u).second.e.col(1));
  }
}

TEST(Subdivision, SeveralPartsAreThePiecesOfTheCurve) {
  Generator generator(4);
  for (int i = 0; i < 1000; ++i) {
    const RancfElement element = random_element(generator);
    std::vector<double> ends{0};
    for (int n = 1 + int(generator() % 7); n > 0; --n)
      ends.push_back(ends.back() + uniform(generator, 0.1, 1));
    for (double& u : ends) u /= ends.back();
    const std::vector<RancfElement> parts = subdivide(element, {ends.begin() + 1, ends.end() - 1});
    ASSERT_EQ(parts.size() + 1, ends.size());
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const RationalCubic piece = curve_of(element).piece(ends[p], ends[p + 1]);
      ASSERT_LE(relative_difference(curve_of(parts[p]), piece), 1e-12);
      ASSERT_NEAR(parts[p].l, element.l * (ends[p + 1] - ends[p]), 1e-14 * element.l);
    }
  }
}

TEST(Subdivision, ParametersThatAreNotInsideAreRefused) {
  for (const double u : {0.0, 1.0, -0.1, std::nan("")})
    EXPECT_THROW(split(paper_element(), u), std::invalid_argument) << u;
  EXPECT_THROW(subdivide(paper_element(), {0.5, 0.5}), std::invalid_argument);
  EXPECT_THROW(subdivide(paper_element(), {0.5, 1.0}), std::invalid_argument);
}

// ---- Eq. 8 ----

TEST(Subdivision, AChangeOfParameterKeepsTheShapeAndTheShapeFactors) {
  Generator generator(5);
  for (int i = 0; i < 2000; ++i) {
    const RancfElement element = random_element(generator);
    const double c = std::exp(uniform(generator, -1, 1)), lambda = std::exp(uniform(generator, -1, 1));
    const RancfElement other = reparametrised(element, c, lambda, uniform(generator, 0.1, 3));
    const RationalCubic curve = curve_of(element), other_curve = curve_of(other);
    ASSERT_LE(relative_difference(RationalCubic(other_curve.points() / lambda), moebius(curve, c)), 1e-14);
    const double t = uniform(generator, 0, 1);
    ASSERT_LE((other_curve.point(t) - curve.point(c * t / (1 - t + c * t))).norm(), 1e-13);
    const NodalCoordinates nodes = to_rancf(other_curve, other.l);
    ASSERT_LE((other.e - nodes).norm(), 1e-13 * (1 + nodes.norm()));
    const ShapeFactors k = shape_factors(element), same = shape_factors(other);
    ASSERT_NEAR(same.k1 / k.k1, 1, 1e-14);
    ASSERT_NEAR(same.k2 / k.k2, 1, 1e-14);
    ASSERT_NEAR(same.k3, k.k3, 1e-13 * element.l * element.l * element.e.squaredNorm());
    const RancfElement back = reparametrised(other, 1 / c, 1 / lambda, element.l);
    ASSERT_LE((back.e - element.e).norm(), 1e-14 * element.e.norm());
    ASSERT_LE((back.weights - element.weights).norm(), 1e-14 * element.weights.norm());
  }
}

TEST(Subdivision, EqualShapeFactorsAreNotEnoughForTheSameShape) {
  const RancfElement element = paper_element();
  RancfElement other = element;
  other.e.col(1) *= 2;
  other.e.col(3) /= 2;
  const ShapeFactors k = shape_factors(element), same = shape_factors(other);
  EXPECT_EQ(same.k1, k.k1);
  EXPECT_EQ(same.k2, k.k2);
  EXPECT_NEAR(same.k3, k.k3, 1e-16);
  const Eigen::Vector3d center(0, 0.5, 0);
  // The printed arc is round to its printed digits.
  EXPECT_NEAR((curve_of(element).point(0.5) - center).norm(), 0.5, 1e-6);
  EXPECT_GT(std::abs((curve_of(other).point(0.5) - center).norm() - 0.5), 1e-3);
}

TEST(Subdivision, ImpossibleChangesOfParameterAreRefused) {
  EXPECT_THROW(reparametrised(paper_element(), 0, 1, 1), std::invalid_argument);
  EXPECT_THROW(reparametrised(paper_element(), 1, -1, 1), std::invalid_argument);
  EXPECT_THROW(reparametrised(paper_element(), 1, 1, std::nan("")), std::invalid_argument);
}

// ---- Eqs. 13-16 ----

TEST(Subdivision, TheParameterDensityFallsAlongTheArcOfThePaperToOne) {
  const RancfElement element = paper_element();
  const ArcLengthMap map(curve_of(element));
  const double length = map.length();
  double last = length / (element.l * element.e.col(1).norm());
  EXPECT_NEAR(parameter_density(map, 1e-6 * length), last, 1e-5);
  for (int i = 1; i <= 100; ++i) {
    const double density = parameter_density(map, length * i / 100);
    EXPECT_LT(density, last);
    last = density;
  }
  EXPECT_NEAR(last, 1, 1e-14);
  EXPECT_THROW(parameter_density(map, 0), std::invalid_argument);
  EXPECT_THROW(parameter_density(map, 1.01 * length), std::invalid_argument);
}

TEST(Subdivision, TheParameterDensityIsTheLimitOfCountedPoints) {
  const RationalCubic curve = curve_of(paper_element());
  const ArcLengthMap map(curve);
  const int total = 2000;
  int count = 0;
  for (int i = 1; i <= total; ++i) {
    const double x = map.arc_length(double(i) / total);
    ++count;  // N(x) points up to and with this one
    const double counted = double(count) / x * map.length() / total;
    ASSERT_NEAR(parameter_density(map, x), counted, 1e-11 * counted);
    // Between two points N(x) is one behind at most: Eq. 13 differs by at most L_T / (x N_T).
    const double between = x - 0.5 * (x - map.arc_length((i - 1.0) / total));
    const double behind = (count - 1) / between * map.length() / total;
    ASSERT_LE(std::abs(parameter_density(map, between) - behind), map.length() / (between * total));
    // Eqs. 14 and 16 with the counted density.
    const double u = count / double(total);
    ASSERT_NEAR(u / counted, x / map.length(), 1e-14);
    ASSERT_NEAR(map.parameter(x) / parameter_density(map, x), x / map.length(), 1e-14);
  }
}

// ---- Eqs. 17-19 ----

TEST(Subdivision, TheArcOfThePaperIsDividedAtTheReferenceParameters) {
  const ArcLengthMap map(curve_of(paper_element()));
  EXPECT_NEAR(map.length(), 0.523598570073, 1e-12);
  const std::vector<std::vector<double>> expected{
      {},
      {0.588684780485},
      {0.420846421571, 0.738147866295},
      {},
      {0.268910142285, 0.490564211113, 0.680225978035, 0.847771646225}};
  for (const int n : {1, 2, 3, 5}) {
    const std::vector<double> found = graded_parameters(map, n, 0);
    ASSERT_EQ(found.size(), expected[n - 1].size());
    for (std::size_t j = 0; j < found.size(); ++j) EXPECT_NEAR(found[j], expected[n - 1][j], 6e-13);
  }
}

TEST(Subdivision, PartsOfAnElementGrowByTheIncrement) {
  const RancfElement element = paper_element();
  const ArcLengthMap map(curve_of(element));
  for (const int n : {2, 3, 5, 8})
    for (const double share : {-0.9, -0.3, 0.0, 0.5, 0.95}) {
      const double k = share * grading_limit(map.length(), n);
      const std::vector<RancfElement> parts = subdivide(element, graded_parameters(map, n, k));
      double total = 0;
      for (std::size_t p = 0; p < parts.size(); ++p) {
        const double here = length(curve_of(parts[p]));
        EXPECT_NEAR(here, map.length() / n + k * (double(p) - 0.5 * (n - 1)), 1e-13);
        total += here;
      }
      EXPECT_NEAR(total, map.length(), 1e-13);
    }
}

TEST(Subdivision, GradedPlacesAreThoseOfEquation17) {
  Generator generator(6);
  for (int i = 0; i < 2000; ++i) {
    const double length = std::exp(uniform(generator, -5, 5));
    const int n = 1 + int(generator() % 12);
    const double k =
        n == 1 ? uniform(generator, -1, 1) : uniform(generator, -1, 1) * grading_limit(length, n);
    const std::vector<double> places = graded_places(length, n, k);
    ASSERT_EQ(int(places.size()), n - 1);
    const double x1 = (length - k * (n - 1) * n / 2) / n;
    for (int j = 1; j < n; ++j) {
      ASSERT_NEAR(places[j - 1], j * x1 + k * (j - 1) * j / 2, 1e-14 * n * length);
      ASSERT_GT(places[j - 1], j > 1 ? places[j - 2] : 0);
    }
    if (n > 1) ASSERT_LT(places.back(), length);
  }
}

TEST(Subdivision, AtTheEndsOfItsRangeTheIncrementClosesAPart) {
  for (const int n : {2, 3, 5, 20}) {
    const double length = 3, limit = grading_limit(length, n);
    EXPECT_NEAR(limit, 2 * length / ((n - 1) * n), 1e-15);
    EXPECT_NEAR(graded_places(length, n, limit * (1 - 1e-6)).front(), 1e-6 * length / n, 1e-12);
    EXPECT_NEAR(length - graded_places(length, n, -limit * (1 - 1e-6)).back(), 1e-6 * length / n, 1e-12);
    for (const double k : {limit, -limit, std::nextafter(limit, 0), 2 * limit, std::nan("")})
      EXPECT_THROW(graded_places(length, n, k), std::invalid_argument) << n << " " << k;
  }
  try {
    graded_places(2, 5, 0.25);
    FAIL();
  } catch (const std::invalid_argument& refusal) {
    const std::string words = refusal.what();
    for (const char* part :
         {"0.25 m", "5 parts of a length of 2 m", "greater than -0.2 m", "less than 0.2 m"})
      EXPECT_NE(words.find(part), std::string::npos) << words;
  }
  EXPECT_THROW(graded_places(0, 2, 0), std::invalid_argument);
  EXPECT_THROW(graded_places(1, 0, 0), std::invalid_argument);
}

// ---- Home nodes ----

TEST(Subdivision, HomeNodesStandAtTheGradedPlacesOfEachInterval) {
  const std::vector<HomeNode> home = home_nodes({0, 2, 3}, {4, 2}, 0.1);
  const std::vector<double> expected{0, 0.35, 0.8, 1.35, 2, 2.45, 3};
  ASSERT_EQ(home.size(), expected.size());
  for (std::size_t i = 0; i < home.size(); ++i) {
    EXPECT_NEAR(home[i].s, expected[i], 1e-15);
    EXPECT_EQ(home[i].permanent, i == 4);
  }
}

TEST(Subdivision, TheRangeOfTheTightestIntervalIsNamed) {
  try {
    home_nodes({0, 2, 3}, {2, 2}, -3);
    FAIL();
  } catch (const std::invalid_argument& refusal) {
    const std::string words = refusal.what();
    for (const char* part :
         {"-3 m", "2 parts of a length of 1 m", "less than 1 m", "between s = 2 m and s = 3 m"})
      EXPECT_NE(words.find(part), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace nurbeam
