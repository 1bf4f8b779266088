#include "cad_import/dxf/drawn_arcs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nurbeam {
namespace {

/// How many quarters of a turn an arc is made of.
int pieces_of(double sweep) {
  return std::max(1, static_cast<int>(std::ceil(sweep / (0.5 * std::numbers::pi) - 1e-9)));
}

std::vector<double> knots_of_pieces(int pieces) {
  std::vector<double> knots(3, 0);
  for (int i = 1; i <= pieces; ++i) knots.insert(knots.end(), i == pieces ? 3 : 2, i);
  return knots;
}

/// The arc through these places, an odd number of them at equal angles, from each second one to the next a
/// conic section whose own weight in the middle is `weight`.
NurbsCurve arc_through(const std::vector<Eigen::Vector3d>& places, double weight) {
  Eigen::Matrix4Xd points(4, places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto point = points.col(static_cast<Eigen::Index>(i));
    if (i % 2 == 0)
      point << places[i], 1;
    else
      point << (1 + weight) * places[i] - 0.5 * (places[i - 1] + places[i + 1]), weight;
  }
  return {KnotVector(2, knots_of_pieces(static_cast<int>(places.size() / 2))), std::move(points)};
}

}  // namespace

NurbsCurve polyline_through(const std::vector<Eigen::Vector3d>& places) {
  Eigen::Matrix3Xd points(3, places.size());
  std::vector<double> knots{0};
  for (std::size_t i = 0; i < places.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) = places[i];
    knots.push_back(static_cast<double>(i));
  }
  knots.push_back(knots.back());
  return make_nurbs_curve(KnotVector(1, std::move(knots)), points, Eigen::VectorXd::Ones(points.cols()));
}

NurbsCurve conic_arc(const Eigen::Vector3d& centre, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                     double from, double sweep) {
  const int pieces = pieces_of(sweep);
  const double half = 0.5 * sweep / pieces, weight = std::cos(half);
  Eigen::Matrix4Xd points(4, 2 * pieces + 1);
  for (int i = 0; i <= 2 * pieces; ++i) {
    const double w = i % 2 == 0 ? 1 : weight, t = from + i * half;
    points.col(i) << w * centre + std::cos(t) * a + std::sin(t) * b, w;
  }
  return {KnotVector(2, knots_of_pieces(pieces)), std::move(points)};
}

NurbsCurve arc_over_chord(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double b,
                          const Eigen::Vector3d& normal) {
  const Eigen::Vector3d chord = to - from, left = normal.cross(chord);
  const double sweep = 4 * std::atan(b);
  const double chord_of_diameter = 2 * b / (1 + b * b);  // sin(sweep / 2)
  const int pieces = pieces_of(std::abs(sweep));
  std::vector<Eigen::Vector3d> places{from};
  for (int i = 1; i < 2 * pieces; ++i) {
    const double angle = i * sweep / (2 * pieces), turn = 0.5 * (angle - sweep);
    places.push_back(from + std::sin(0.5 * angle) / chord_of_diameter *
                                (std::cos(turn) * chord + std::sin(turn) * left));
  }
  places.push_back(to);
  return arc_through(places, std::cos(0.5 * sweep / pieces));
}

}  // namespace nurbeam
