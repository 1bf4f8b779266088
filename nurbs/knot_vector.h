#pragma once
#include <vector>

namespace nurbeam {

/// Degree and the full non-decreasing knots of a NURBS curve, both ends included; an invalid one cannot
/// exist.
///
/// knots = (u_0, ..., u_{n+p}), n control points, degree p; the curve lives on [u_p, u_n] (Piegl & Tiller,
/// The NURBS Book, Eq. 2.13, with the end knots not required to be clamped).
class KnotVector {
 public:
  /// Throws std::invalid_argument (message: value and rule) unless degree >= 1, all knots are finite and
  /// non-decreasing, there are at least 2 (degree + 1) of them, no interior knot has a multiplicity above the
  /// degree, no end knot one above degree + 1, start() < end(), and knots that differ are 1e-60 apart or
  /// more.
  KnotVector(int degree, std::vector<double> knots);

  int degree() const { return degree_; }
  const std::vector<double>& knots() const { return knots_; }
  int control_point_count() const { return static_cast<int>(knots_.size()) - degree_ - 1; }
  double start() const { return knots_[degree_]; }
  double end() const { return knots_[control_point_count()]; }

  /// Index i with knots[i] <= u < knots[i+1], within [degree, control_point_count - 1]; the last non-empty
  /// span for u >= end(), the first for u < start().
  int find_span(double u) const;
  /// How often u stands among the knots (exact comparison).
  int multiplicity(double u) const;
  /// The different knots in [start(), end()], ends included.
  std::vector<double> breaks() const;

  bool operator==(const KnotVector&) const = default;

 private:
  int degree_;
  std::vector<double> knots_;
};

}  // namespace nurbeam
