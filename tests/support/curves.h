#pragma once
#include <Eigen/Core>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "nurbs/bezier_path.h"
#include "nurbs/nurbs_curve.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// Curves with a known shape, and random ones from a seeded generator.
using Generator = std::mt19937_64;

inline double uniform(Generator& generator, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(generator);
}

inline Eigen::Vector3d random_point(Generator& generator) {
  return {uniform(generator, -1, 1), uniform(generator, -1, 1), uniform(generator, -1, 1)};
}

/// Control points in the cube [-1,1]^3 + origin, weights in [0.3, 3].
inline RationalCubic random_cubic(Generator& generator,
                                  const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) {
    const double weight = uniform(generator, 0.3, 3);
    points.col(i) << weight * (origin + random_point(generator)), weight;
  }
  return RationalCubic(points);
}

/// Knots with random gaps and random interior multiplicities up to the degree; clamped, or running on at both
/// ends.
inline KnotVector random_knots(Generator& generator, int degree, bool clamped) {
  std::vector<double> knots(degree + 1, uniform(generator, -2, 2));
  for (int spans = 1 + int(generator() % 5); spans > 0; --spans) {
    const double next = knots.back() + uniform(generator, 0.1, 1);
    knots.insert(knots.end(), spans > 1 ? 1 + generator() % degree : degree + 1, next);
  }
  if (!clamped)
    for (int i = 0; i < degree; ++i) {
      knots[i] -= uniform(generator, 0, 0.2) + (degree - i) * 0.2;
      knots[knots.size() - 1 - i] += uniform(generator, 0, 0.2) + (degree - i) * 0.2;
    }
  return {degree, std::move(knots)};
}

/// Random points and weights in [0.3, 3] (all 1 unless rational) on random knots.
inline NurbsCurve random_nurbs(Generator& generator, int degree, bool rational, bool clamped) {
  KnotVector knots = random_knots(generator, degree, clamped);
  Eigen::Matrix3Xd points(3, knots.control_point_count());
  Eigen::VectorXd weights(knots.control_point_count());
  for (int i = 0; i < points.cols(); ++i) {
    points.col(i) = random_point(generator);
    weights(i) = rational ? uniform(generator, 0.3, 3) : 1;
  }
  return make_nurbs_curve(std::move(knots), points, weights);
}

/// The unit circle in the xy plane from four rational quadratic quarters; one more knot on each side.
inline NurbsCurve unit_circle(double first_knot = 0, double last_knot = 4) {
  const double h = std::sqrt(0.5);
  Eigen::Matrix3Xd points(3, 9);
  points << 1, 1, 0, -1, -1, -1, 0, 1, 1, 0, 1, 1, 1, 0, -1, -1, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0;
  Eigen::VectorXd weights(9);
  weights << 1, h, 1, h, 1, h, 1, h, 1;
  return make_nurbs_curve(KnotVector(2, {first_knot, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, last_knot}), points,
                          weights);
}

/// An arc of the given radius about the origin in the xy plane, from the x axis on, less than 180 degrees
/// [rad].
inline NurbsCurve circular_arc(double radius, double angle) {
  const double h = std::cos(0.5 * angle);
  Eigen::Matrix3Xd points(3, 3);
  points << radius, radius, radius * std::cos(angle), 0, radius * std::tan(0.5 * angle),
      radius * std::sin(angle), 0, 0, 0;
  return make_nurbs_curve(KnotVector(2, {0, 0, 0, 1, 1, 1}), points, Eigen::Vector3d(1, h, 1));
}

/// A straight line on the parameters [0, 1].
inline NurbsCurve line(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Eigen::Matrix3Xd points(3, 2);
  points << from, to;
  return make_nurbs_curve(KnotVector(1, {0, 0, 1, 1}), points, Eigen::Vector2d(1, 1));
}

/// The cubic r(c t / (1 - t + c t)): the same shape, run through at another speed.
inline RationalCubic moebius(const RationalCubic& cubic, double c) {
  return RationalCubic(cubic.points() * Eigen::Vector4d(1, c, c * c, c * c * c).asDiagonal());
}

/// A connected path of random gentle cubics (none turns by 90 degrees), weights in [0.5, 2] and free at
/// joints.
inline BezierPath random_path(Generator& generator, int count) {
  BezierPath path{{}, {uniform(generator, -1, 1)}, 0};
  Eigen::Vector3d start = random_point(generator);
  for (int j = 0; j < count; ++j) {
    Eigen::Matrix4d points;
    for (int i = 0; i < 4; ++i) {
      const double weight = uniform(generator, 0.5, 2);
      const Eigen::Vector3d along(1.0 * i, 0, 0);
      points.col(i) << weight * (start + along + (i == 0 ? 0 : 0.2) * random_point(generator)), weight;
    }
    path.segments.emplace_back(points);
    start = path.segments.back().control_point(3);
    path.breaks.push_back(path.breaks.back() + uniform(generator, 0.1, 1));
  }
  return path;
}

}  // namespace nurbeam
