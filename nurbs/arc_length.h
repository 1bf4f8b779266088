#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "nurbs/gauss_panels.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// The speed |r'(u)| = |hodograph(u)| / W(u)^2 of a rational cubic.
class Speed {
 public:
  explicit Speed(const RationalCubic& cubic);
  double operator()(double u) const;
  /// The speed and its first and second derivative by u.
  std::array<double, 3> derivatives(double u) const;
  /// Whether it is the same everywhere, to round-off: a straight line in even steps.
  bool uniform() const { return uniform_; }

 private:
  Eigen::Matrix<double, 3, 5> hodograph_;
  Eigen::RowVector4d weights_;
  bool uniform_;
};

/// Length of a rational cubic [m], to about 1e-14; cusps are allowed.
double length(const RationalCubic& cubic);

/// Arc length s(u) of a rational cubic on [0,1] and its inverse, both to about 1e-14 of the length
/// (adaptive Gauss panels, and for the inverse the polynomials of degree 7 on them that have its value and
/// three derivatives at both ends; subdivision paper Eqs. 12-16).
class ArcLengthMap {
 public:
  /// Throws std::invalid_argument when the speed |r'(u)| vanishes on [0,1] (the value and place are named).
  explicit ArcLengthMap(const RationalCubic& cubic);

  double length() const { return panels_.integrals.back(); }
  /// s(u) [m]; u slightly outside [0,1] extrapolates.
  double arc_length(double u) const;
  /// u(s); s slightly outside [0, length] extrapolates.
  double parameter(double s) const;

 private:
  // u(s) on one panel: the coefficients of u - u(start) by powers of t = (s - start)/length.
  struct Inverse {
    std::array<double, 7> coefficients;
    bool exact;  // to round-off; else it is a first guess
    double operator()(double t) const;
  };
  Inverse inverse_on(std::size_t panel) const;
  double by_newton(std::size_t panel, double from_start) const;

  Speed speed_;
  Panels panels_;                  // of the speed: breaks in u, integrals in s
  std::vector<Inverse> inverses_;  // on the panels; none where the speed is uniform
};

}  // namespace nurbeam
