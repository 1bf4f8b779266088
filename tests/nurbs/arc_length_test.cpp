#include "nurbs/arc_length.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

/// The element of the subdivision paper: an arc of radius 1/2 over 60 degrees with an uneven parameter. Its
/// slopes and weights are printed with 8 to 9 digits.
RationalCubic paper_element() {
  const double l = std::numbers::pi / 6;
  const double w[] = {1, 1.08621103, 0.98905339, 1};
  const Eigen::Vector3d start(0, 0, 0), end(0.5 * std::sin(std::numbers::pi / 3), 0.25, 0);
  const Eigen::Vector3d slope_a(0.667185831, 0, 0), slope_b(0.68333751, 1.18361, 0);
  Eigen::Matrix4d points;
  points << w[0] * start, w[1] * start + w[0] * l / 3 * slope_a, w[2] * end - w[3] * l / 3 * slope_b,
      w[3] * end, w[0], w[1], w[2], w[3];
  return RationalCubic(points);
}

TEST(ArcLengthTest, TheElementOfTheSubdivisionPaperIsDividedAtTheReferenceParameters) {
  const ArcLengthMap map(paper_element());
  const double s = map.length();
  EXPECT_NEAR(s, 0.523598570073, 1e-12);
  EXPECT_NEAR(map.parameter(s / 2), 0.588684780485, 1e-12);
  EXPECT_NEAR(map.parameter(s / 3), 0.420846421571, 1e-12);
  EXPECT_NEAR(map.parameter(s * 2 / 3), 0.738147866295, 1e-12);
  EXPECT_NEAR(map.parameter(s / 5), 0.268910142285, 1e-12);
  EXPECT_NEAR(map.parameter(s * 2 / 5), 0.490564211113, 1e-12);
  EXPECT_NEAR(map.parameter(s * 3 / 5), 0.680225978035, 1e-12);
  EXPECT_NEAR(map.parameter(s * 4 / 5), 0.847771646225, 1e-12);
}

TEST(ArcLengthTest, OnAnArcItIsTheAngle) {
  const RationalCubic arc = BezierPath::from_nurbs(circular_arc(1, 1.5), 1e-9).segments.front();
  for (const double c : {1.0, 4.0, 0.05}) {
    const ArcLengthMap map(moebius(arc, c));
    EXPECT_NEAR(map.length(), 1.5, 1e-14);
    for (int i = 0; i <= 100; ++i) {
      const Eigen::Vector3d r = moebius(arc, c).point(0.01 * i);
      EXPECT_NEAR(map.arc_length(0.01 * i), std::atan2(r(1), r(0)), 1e-14);
      const double s = 0.015 * i;
      EXPECT_LE(
          (moebius(arc, c).point(map.parameter(s)) - Eigen::Vector3d(std::cos(s), std::sin(s), 0)).norm(),
          1e-14);
    }
  }
}

TEST(ArcLengthTest, TheParameterIsTheInverseOnRandomCurves) {
  Generator generator(20);
  for (int i = 0; i < 2000; ++i) {
    const ArcLengthMap map(random_cubic(generator));
    for (int k = 0; k < 5; ++k) {
      const double s = uniform(generator, 0, map.length());
      ASSERT_NEAR(map.arc_length(map.parameter(s)), s, 2e-14 * map.length());
    }
    ASSERT_NEAR(map.parameter(0), 0, 1e-15);
    ASSERT_NEAR(map.parameter(map.length()), 1, 1e-13);
  }
}

TEST(ArcLengthTest, ItGrowsAtTheSpeed) {
  Generator generator(21);
  for (int i = 0; i < 500; ++i) {
    const RationalCubic cubic = random_cubic(generator);
    const ArcLengthMap map(cubic);
    const double u = uniform(generator, 0.1, 0.9);
    const Speed speed(cubic);
    ASSERT_NEAR(speed(u), cubic.derivatives(u).col(1).norm(), 1e-12);
    // Simpson's rule is exact to h^5 for smooth speeds; near a cusp of a random curve they are not.
    const double h = 1e-4;
    const double simpson = h / 3 * (speed(u - h) + 4 * speed(u) + speed(u + h));
    ASSERT_NEAR(map.arc_length(u + h) - map.arc_length(u - h), simpson, 1e-7 * h * map.length());
  }
}

TEST(ArcLengthTest, TheDerivativesOfTheSpeedAreThoseOfItsDifferences) {
  Generator generator(23);
  for (int i = 0; i < 500; ++i) {
    const RationalCubic cubic = random_cubic(generator);
    const Speed speed(cubic);
    const double u = uniform(generator, 0.1, 0.9), h = 1e-4;
    const auto [v, v_u, v_uu] = speed.derivatives(u);
    // Of order two: near a cusp the differences are off by its distance.
    const double scale = (cubic.points().topRows<3>().colwise() - cubic.points().col(0).head<3>()).norm();
    if (v < 0.1 * scale) continue;
    ASSERT_NEAR(v, speed(u), 1e-14 * scale);
    ASSERT_NEAR(v_u, (speed(u + h) - speed(u - h)) / (2 * h), 1e-4 * scale);
    ASSERT_NEAR(v_uu, (speed(u + h) - 2 * v + speed(u - h)) / (h * h), 1e-2 * scale);
  }
}

TEST(ArcLengthTest, OnAnEvenLineItIsAProportionAndOnAnUnevenOneItIsNot) {
  const Eigen::Vector4d a(3, -2, 7, 1), b(4.5, 0, 9.25, 1);
  const auto line = [&](double second, double third) {
    Eigen::Matrix4d points;
    points << a, a + second * (b - a), a + third * (b - a), b;
    return RationalCubic(points);
  };
  const ArcLengthMap even(line(1.0 / 3, 2.0 / 3)), uneven(line(0.3, 0.6));
  EXPECT_TRUE(Speed(line(1.0 / 3, 2.0 / 3)).uniform());
  EXPECT_FALSE(Speed(line(1.0 / 3 + 1e-12, 2.0 / 3)).uniform());
  for (const double part : {-0.1, 0.0, 0.2, 0.7, 1.0, 1.3}) {
    const double s = part * (b - a).norm();
    EXPECT_NEAR(even.parameter(s), part, 1e-15);
    // Of a line with the coordinate 0.9 u + 0.1 u^3 along it.
    const double u = uneven.parameter(s);
    EXPECT_NEAR(0.9 * u + 0.1 * u * u * u, part, 1e-14);
  }
}

TEST(ArcLengthTest, ThePiecesAreAsLongAsTheWhole) {
  Generator generator(22);
  for (int i = 0; i < 2000; ++i) {
    const RationalCubic whole = random_cubic(generator);
    const double cut = uniform(generator, 0.05, 0.95);
    const auto [left, right] = whole.split(cut);
    ASSERT_NEAR((length(left) + length(right)) / length(whole), 1, 2e-14);
    ASSERT_NEAR(ArcLengthMap(whole).arc_length(cut) / length(left), 1, 1e-13);
    ASSERT_NEAR(length(moebius(whole, 1.7)) / length(whole), 1, 1e-13);
  }
}

TEST(ArcLengthTest, OutsideTheCurveItIsThatOfTheExtendedCurve) {
  const RationalCubic arc = BezierPath::from_nurbs(circular_arc(1, 1.5), 1e-9).segments.front();
  const ArcLengthMap map(arc.piece(0.1, 0.9));
  for (const double u : {-0.1, -1e-3, 1.001, 1.1}) {
    const Eigen::Vector3d from = arc.point(0.1), to = arc.piece(0.1, 0.9).point(u);
    EXPECT_NEAR(map.arc_length(u), std::atan2(to(1), to(0)) - std::atan2(from(1), from(0)), 1e-14);
    EXPECT_NEAR(map.parameter(map.arc_length(u)), u, 1e-14);
  }
}

/// The words with which the map refuses a cubic with these x and y (z = 0, weights 1).
std::string refusal(const Eigen::RowVector4d& x, const Eigen::RowVector4d& y) {
  Eigen::Matrix4d points;
  points << x, y, Eigen::RowVector4d::Zero(), Eigen::RowVector4d::Ones();
  try {
    ArcLengthMap{RationalCubic(points)};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ArcLengthTest, AVanishingSpeedIsRefusedWithItsPlace) {
  EXPECT_NE(refusal({0, 0, 1, 2}, {0, 0, 0, 1}).find("at u = 0 "), std::string::npos);
  EXPECT_NE(refusal({0, 1, 2, 2}, {0, 0, 1, 1}).find("at u = 1 "), std::string::npos);
  // (t^2, t^3) from -1/2 to 1: the cusp at t = 0 is at u = 1/3.
  const std::string cusp = refusal({0.25, -0.25, 0, 1}, {-0.125, 0.25, -0.5, 1});
  EXPECT_NE(cusp.find("at u = 0.33333"), std::string::npos) << cusp;
  EXPECT_NE(refusal({1, 1, 1, 1}, {2, 2, 2, 2}).find("0 m long"), std::string::npos);
  EXPECT_EQ(refusal({0, 1, 2, 3}, {0, 0, 1, 1}), "");
}

}  // namespace
}  // namespace nurbeam
