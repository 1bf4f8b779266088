#include "nurbs/curve_through.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace nurbeam::of_curves_through {
namespace {

using std::numbers::pi;
using Points = std::vector<Eigen::Vector3d>;

Eigen::Vector3d helix(double turn) {
  return {0.02 * std::cos(2 * pi * turn), 0.02 * std::sin(2 * pi * turn), 0.012 * turn};
}

Points helix_points(int count, double uneven) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double x = i / (count - 1.0);
    points.push_back(helix(5 * (x + uneven * std::sin(2 * pi * x) / (2 * pi))));
  }
  return points;
}

double distance_to(const NurbsCurve& curve, const Eigen::Vector3d& point) {
  double least = 1e9;
  for (const double u : curve.knots().breaks()) least = std::min(least, (curve.point(u) - point).norm());
  return least;
}

TEST(CurveThrough, GoesThroughItsPoints) {
  for (const int degree : {1, 2, 3, 4, 5}) {
    const Points points = helix_points(12, 0.5);
    const NurbsCurve curve = curve_through(points, {.degree = degree});
    EXPECT_EQ(curve.degree(), degree);
    double at = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) at += (points[i] - points[i - 1]).norm();
      const double u = std::min(at, curve.knots().end());
      EXPECT_NEAR((curve.point(u) - points[i]).norm(), 0, 1e-14) << degree << " " << i;
    }
  }
}

// A spring's length, which 8 % of stiffness hang on.
TEST(CurveThrough, HasTheLengthOfASampledHelixToFourthOrder) {
  const double right = 5 * std::hypot(2 * pi * 0.02, 0.012);
  double before = 0;
  for (const int count : {81, 161, 321}) {
    const double error = std::abs(length(curve_through(helix_points(count, 0.1))) - right);
    EXPECT_LT(error, 1e-3 * right);
    if (before > 0) EXPECT_GT(before / error, 10) << count;
    before = error;
  }
}

TEST(CurveThrough, IsSmoothAtItsSeamWhereItIsClosed) {
  Points points;
  for (int i = 0; i < 24; ++i) points.emplace_back(std::cos(2 * pi * i / 24), std::sin(2 * pi * i / 24), 0);
  const NurbsCurve open_end = curve_through(points, {.closed = true});
  points.push_back(points.front());
  const NurbsCurve repeated = curve_through(points, {.closed = true});
  EXPECT_EQ(open_end.control_points(), repeated.control_points());
  const double a = open_end.knots().start(), b = open_end.knots().end();
  const Eigen::Matrix3Xd start = open_end.derivatives(a, 2), end = open_end.derivatives(b, 2);
  for (int k = 0; k <= 2; ++k) EXPECT_NEAR((start.col(k) - end.col(k)).norm(), 0, 1e-9) << k;
  EXPECT_NEAR(length(open_end), 2 * pi, 1e-3);
}

TEST(CurveThrough, HasTheTangentsThatAreGiven) {
  const Points points = {{0, 0, 0}, {1, 0.2, 0}, {2, 0, 0.3}, {3, 0, 0}};
  const Points ends = {{0, 2, 0}, {1, 0, 5}};
  const NurbsCurve clamped = curve_through(points, {.tangents = ends});
  const auto direction = [](const NurbsCurve& curve, double u) {
    return Eigen::Vector3d(curve.derivatives(u, 1).col(1).normalized());
  };
  EXPECT_NEAR((direction(clamped, clamped.knots().start()) - ends[0].normalized()).norm(), 0, 1e-12);
  EXPECT_NEAR((direction(clamped, clamped.knots().end()) - ends[1].normalized()).norm(), 0, 1e-12);
  const Points all = {{1, 1, 0}, {1, 0, 0}, {1, 0, -1}, {0, 0, -1}};
  const NurbsCurve hermite = curve_through(points, {.tangents = all});
  double at = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) at += (points[i] - points[i - 1]).norm();
    EXPECT_NEAR((hermite.point(at) - points[i]).norm(), 0, 1e-14) << i;
    EXPECT_NEAR((direction(hermite, at) - all[i].normalized()).norm(), 0, 1e-12) << i;
  }
}

TEST(CurveThrough, RefusesWhatIsNoCurveAndNamesThePlace) {
  const auto refuses = [](const Points& points, const ThroughPoints& how, const std::string& part) {
    try {
      (void)curve_through(points, how);
      ADD_FAILURE() << part;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refuses({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}, "point 3");
  refuses({{0, 0, 0}, {1, 0, 0}}, {}, "degree 3");
  refuses({{0, 0, 0}}, {.degree = 1}, "at least 2");
  refuses({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 0, 0}}, {.tangents = {{1, 0, 0}}}, "1 tangents for 4 points");
  refuses({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 0, 0}}, {.tangents = {{1, 0, 0}, {0, 0, 0}}}, "tangent 2");
}

}  // namespace
}  // namespace nurbeam::of_curves_through
