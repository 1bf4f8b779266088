#include "solver/algebra/quadratic_programme.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace nurbeam {

namespace {

using Dense = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// The active set of bounds. Bounds enter one by one, the worst first; bounds whose pressure has gone leave.
class DualActiveSet {
 public:
  DualActiveSet(const Dense& H, const Vector& f, const Dense& rows, const Vector& bounds)
      : H_(H), f_(f), rows_(rows), bounds_(bounds) {}

  QuadraticMinimum least(double tolerance) {
    rest_on_held();
    // The minimum grows with each bound, so that no set is met twice, except by round-off.
    const Eigen::Index most = 8 * bounds_.size() + 8;
    for (Eigen::Index round = 0; round < most; ++round) {
      Eigen::Index worst = 0;
      if (bounds_.size() == 0 || (bounds_ - rows_ * x_).maxCoeff(&worst) <= tolerance || !hold(worst)) break;
      rest_on_held();
    }
    QuadraticMinimum found{x_, Vector::Zero(bounds_.size())};
    found.pressures(held_) = pressure_;
    return found;
  }

 private:
  // x and p with H x - rows'p = force and rows x = least, for the rows of held bounds.
  std::pair<Vector, Vector> least_on_held(const Vector& force, const Vector& least) const {
    const Eigen::Index n = f_.size(), m = least.size();
    const double scale = H_.diagonal().maxCoeff();
    const Dense rows = rows_(held_, Eigen::all);
    Dense kkt = Dense::Zero(n + m, n + m);
    kkt.topLeftCorner(n, n) = H_ / scale;
    kkt.topRightCorner(n, m) = -rows.transpose();
    kkt.bottomLeftCorner(m, n) = rows;
    Vector rhs(n + m);
    rhs << force / scale, least;
    const Vector solution = kkt.completeOrthogonalDecomposition().solve(rhs);
    return {solution.head(n), scale * solution.tail(m)};
  }

  void rest_on_held() { std::tie(x_, pressure_) = least_on_held(-f_, bounds_(held_)); }

  // Whether holding the held bounds holds this one too.
  bool depends_on_held(const Vector& row) const {
    if (held_.empty()) return false;
    const Dense columns = rows_(held_, Eigen::all).transpose();
    const Vector parts = columns.completeOrthogonalDecomposition().solve(row);
    return (row - columns * parts).norm() <= 1e-9 * row.norm();
  }

  // Pushes x to a bound that it violates, and releases held bounds that lose their pressure; false where no x
  // satisfies them all.
  bool hold(Eigen::Index bound) {
    constexpr double never = std::numeric_limits<double>::infinity();
    const Vector row = rows_.row(bound);
    double pushed = 0;
    for (;;) {
      const auto [dx, dp] = least_on_held(row, Vector::Zero(pressure_.size()));
      const double to_bound = depends_on_held(row) ? never : (bounds_[bound] - row.dot(x_)) / row.dot(dx);
      double to_release = never;
      Eigen::Index released = 0;
      for (Eigen::Index k = 0; k < dp.size(); ++k)
        if (dp[k] < 0 && pressure_[k] / -dp[k] < to_release) {
          to_release = pressure_[k] / -dp[k];
          released = k;
        }
      const double push = std::min(to_bound, to_release);
      if (!std::isfinite(push)) return false;
      x_ += push * dx;
      pressure_ += push * dp;
      pushed += push;
      if (to_bound <= to_release) {
        held_.push_back(bound);
        pressure_.conservativeResize(pressure_.size() + 1);
        pressure_.tail<1>()[0] = pushed;
        return true;
      }
      held_.erase(held_.begin() + released);
      const Eigen::Index left = pressure_.size() - 1;
      pressure_.segment(released, left - released) = pressure_.tail(left - released).eval();
      pressure_.conservativeResize(left);
    }
  }

  const Dense& H_;
  const Vector& f_;
  const Dense& rows_;
  const Vector& bounds_;
  Vector x_;
  std::vector<Eigen::Index> held_;  // bounds that x is at, whose rows are independent
  Vector pressure_;                 // pressures of the held bounds
};

}  // namespace

QuadraticMinimum least_quadratic(const Dense& H, const Vector& f, const Dense& rows, const Vector& bounds,
                                 double tolerance) {
  return DualActiveSet(H, f, rows, bounds).least(tolerance);
}

}  // namespace nurbeam
