#pragma once
#include <Eigen/Core>
#include <vector>

#include "nurbs/knot_vector.h"

namespace nurbeam {

/// A knot vector and homogeneous control points (wx, wy, wz, w): the CAD curve. Coordinates in metres.
class NurbsCurve {
 public:
  /// control_points: 4 x knots.control_point_count(), column i = (w_i P_i, w_i).
  /// Throws std::invalid_argument unless the counts agree, all values are at most 1e100 and weights positive.
  NurbsCurve(KnotVector knots, Eigen::Matrix4Xd control_points);

  const KnotVector& knots() const { return knots_; }
  const Eigen::Matrix4Xd& control_points() const { return control_points_; }
  int degree() const { return knots_.degree(); }
  /// Whether the weights differ by more than 1e-14 of the largest.
  bool is_rational() const;
  /// Point at u in [start, end], 3 [m].
  Eigen::Vector3d point(double u) const;
  /// Derivatives 0..n with respect to u: column k is d^k r/du^k, 3 x (n+1) (The NURBS Book, Eq. 4.8).
  Eigen::Matrix3Xd derivatives(double u, int n) const;
  /// Homogeneous Bezier points, 4 x (degree + 1), of the polynomial piece on the non-empty knot span
  /// [knots[span], knots[span + 1]].
  Eigen::Matrix4Xd bezier_points(int span) const;
  /// The same curve run through backwards.
  NurbsCurve reversed() const;

 private:
  KnotVector knots_;
  Eigen::Matrix4Xd control_points_;
};

/// Curve from plain control points [m] (3 x n) and weights (n).
NurbsCurve make_nurbs_curve(KnotVector knots, const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights);
/// Whether start and end point agree within the tolerance [m].
bool is_closed(const NurbsCurve& curve, double tolerance);
/// Length [m], to a relative error of about 1e-13.
double length(const NurbsCurve& curve);

}  // namespace nurbeam
