#include "pipelines/section/torsion_constant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipelines/section/cgal_geometry.h"
#include "pipelines/section/section_profile.h"
#include "tests/support/profiles.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

/// Tests of what only a build with CGAL computes.
class TorsionConstant : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_cgal()) GTEST_SKIP() << "this build is without CGAL";
  }
  static TorsionReport torsion(const std::vector<Outline>& outlines, double relative_error = 1e-6) {
    const ProfileReport profile = section_profile(imported(outlines), "profile");
    return torsion_constant(profile.value.value().loops, {.relative_error = relative_error});
  }
  /// J is `exact` to within the error that is reported, which is a millionth.
  static void expect_exact(const TorsionReport& report, double exact) {
    EXPECT_EQ(report.status, TorsionStatus::done);
    EXPECT_LE(report.error, 1e-6 * report.value);
    EXPECT_NEAR(report.value, exact, report.error);
  }
};

TEST_F(TorsionConstant, OfACircleAndARingIsThePolarMoment) {
  expect_exact(torsion({ellipse(0.01, 0.01)}), pi / 2 * 1e-8);
  expect_exact(torsion({ellipse(0.01, 0.01), ellipse(0.006, 0.006)}), pi / 2 * (1e-8 - std::pow(0.006, 4)));
  expect_exact(torsion({ellipse(1, 1), ellipse(0.99, 0.99)}), pi / 2 * (1 - std::pow(0.99, 4)));
}

TEST_F(TorsionConstant, OfAnEllipseIsSaintVenants) {
  for (const double b : {0.5, 0.1}) expect_exact(torsion({ellipse(1, b)}), pi * b * b * b / (1 + b * b));
}

TEST_F(TorsionConstant, OfARectangleIsSaintVenantsSeries) {
  // Timoshenko and Goodier, Theory of Elasticity, section 109.
  for (const double b : {1.0, 0.5, 0.1, 0.01}) {
    double sum = 0;
    for (int n = 1; n < 1000; n += 2) sum += std::tanh(n * pi / (2 * b)) / std::pow(n, 5);
    expect_exact(torsion({rectangle(1, b)}), b * b * b / 3 * (1 - 192 * b / std::pow(pi, 5) * sum));
  }
}

TEST_F(TorsionConstant, OfAnEquilateralTriangleIsSaintVenants) {
  expect_exact(torsion({polygon({{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}})}), std::sqrt(3.0) / 80);
}

TEST_F(TorsionConstant, OfAShaftWithACircularGrooveIsWebers) {
  // A circle with a circular groove of half its radius centred on its edge (C. Weber 1921):
  // phi = (r^2 - b^2)(2 a cos(theta)/r - 1)/2, integrated here over r by hand and over theta numerically.
  const double a = 1, b = 0.5;
  // theta from the axis into the shaft, about the groove's centre; r from b to 2 a cos(theta).
  const double end = std::acos(b / (2 * a));
  double J = 0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double theta = -end + 2 * end * (i + 0.5) / n, c = 2 * a * std::cos(theta);
    // 2 phi r = (r^2 - b^2)(c - r), integrated over r.
    const auto primitive = [&](double r) {
      return c * r * r * r / 3 - r * r * r * r / 4 - b * b * (c * r - r * r / 2);
    };
    J += (primitive(c) - primitive(b)) * 2 * end / n;
  }
  // From the groove's far end on the shaft: the circle (centre (a, 0)) and the groove (centre the origin).
  const double x = b * b / (2 * a), y = std::sqrt(b * b - x * x), shaft = pi - std::atan2(y, a - x);
  const auto arc = [](double cx, double radius, double from, double to) {
    // In pieces below 90 degrees.
    Outline pieces;
    const int count = 6;
    for (int k = 0; k < count; ++k) {
      const double s = from + (to - from) * k / count, e = from + (to - from) * (k + 1) / count;
      const double h = std::cos((e - s) / 2);
      Eigen::Matrix3d points;
      points << radius * std::cos(s) + cx, radius * std::cos((s + e) / 2) / h + cx, radius * std::cos(e) + cx,
          radius * std::sin(s), radius * std::sin((s + e) / 2) / h, radius * std::sin(e), 0, 0, 0;
      pieces.push_back(make_nurbs_curve(KnotVector(2, {0, 0, 0, 1, 1, 1}), points, Eigen::Vector3d(1, h, 1)));
    }
    return pieces;
  };
  Outline outline = arc(a, a, -shaft, shaft);
  const double groove = std::atan2(y, x);
  for (const NurbsCurve& piece : arc(0, b, groove, -groove)) outline.push_back(piece);
  const TorsionReport report = torsion({outline});
  EXPECT_EQ(report.status, TorsionStatus::done);
  EXPECT_NEAR(report.value, J, report.error + 1e-7 * J);
}

TEST_F(TorsionConstant, OfAThinWalledOpenSectionIsTheSumOfItsWalls) {
  // A channel of walls 1 by 0.01: the sum of b t^3 / 3 along the middle line, less what the three free and
  // the two inner corners change, of order t^4.
  const double t = 0.01;
  const Outline channel = polygon({{0, 0}, {1, 0}, {1, t}, {t, t}, {t, 1 - t}, {1, 1 - t}, {1, 1}, {0, 1}});
  const TorsionReport report = torsion({channel});
  const double middle_line = (1 - t / 2) * 2 + (1 - t);
  EXPECT_EQ(report.status, TorsionStatus::done);
  EXPECT_NEAR(report.value, middle_line * t * t * t / 3, t * t * t * t);
}

TEST_F(TorsionConstant, OfAThinWalledClosedSectionIsBredts) {
  // A box of walls t and 2 t around the middle line 1 by 1: 4 A^2 / (sum of b / t).
  const double t = 0.002;
  const TorsionReport report =
      torsion({polygon({{-t, -t / 2}, {1 + t, -t / 2}, {1 + t, 1 + t / 2}, {-t, 1 + t / 2}}),
               polygon({{t, t / 2}, {1 - t, t / 2}, {1 - t, 1 - t / 2}, {t, 1 - t / 2}})},
              1e-5);
  const double bredt = 4 / (2 / t + 2 / (2 * t));
  EXPECT_EQ(report.status, TorsionStatus::done);
  EXPECT_NEAR(report.value, bredt, 5 * t * bredt);
  EXPECT_GT(report.value, bredt);  // the walls' own stiffness
}

TEST_F(TorsionConstant, OfAnIpe200AgreesWithItsTable) {
  // EN 10365: 6.98 cm^4, itself from a fit to experiments for the fillets (El Darwish and Johnston 1965).
  const TorsionReport report = torsion({i_section(0.2, 0.1, 0.0056, 0.0085, 0.012)});
  EXPECT_EQ(report.status, TorsionStatus::done);
  EXPECT_NEAR(report.value, 6.98e-8, 0.03 * 6.98e-8);
}

TEST_F(TorsionConstant, TheErrorIsABoundAtEveryAccuracy) {
  for (const double wanted : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const TorsionReport report = torsion({ellipse(1, 0.4)}, wanted);
    EXPECT_LE(report.error, wanted * report.value);
    EXPECT_NEAR(report.value, pi * 0.064 / 1.16, report.error);
  }
}

TEST_F(TorsionConstant, WhatThePointsDoNotSufficeForIsSaidToBeCoarse) {
  const ProfileReport profile = section_profile(imported({rectangle(1, 1)}), "profile");
  const TorsionReport report =
      torsion_constant(profile.value->loops, {.relative_error = 1e-9, .most_points = 300});
  EXPECT_EQ(report.status, TorsionStatus::coarse);
  EXPECT_GT(report.error, 1e-9 * report.value);
  EXPECT_NEAR(report.value, 0.1405770150, report.error);
  const ProfileReport foil =
      section_profile(imported({ellipse(1, 1), ellipse(1 - 1e-6, 1 - 1e-6)}), "profile");
  EXPECT_EQ(torsion_constant(foil.value.value().loops).status, TorsionStatus::no_mesh);
}

}  // namespace
}  // namespace nurbeam
