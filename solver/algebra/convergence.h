#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbeam {

/// The norms of the residuals and corrections of one step, and the contraction of each by the last
/// correction.
class Convergence {
 public:
  /// Contraction of corrections below which a matrix is reused.
  static constexpr double good_contraction = 0.1;

  /// Takes the norm of a residual and of the correction that answered it; both have one tolerance.
  bool reached(double residual, double correction, double tolerance) {
    contraction_ = correction / correction_;
    const double last = correction_, balance = residual / residual_;
    correction_ = correction;
    residual_ = residual;
    const bool small = correction <= tolerance;
    if (!std::isfinite(last)) return false;
    // Where forces are in balance, one more correction takes the rest; the last two predict what would
    // remain.
    const bool foretold = contracts() && contraction_ * correction <= tolerance;
    if (residual <= tolerance && (small || foretold)) return true;
    // Where residual and corrections shrink quickly, the balance is predicted as well, with much to spare.
    // The predicted rate is no quicker than that of a reused matrix, whatever its first correction has done.
    const double rate = std::max({balance, contraction_, quickest_kept});
    if (foretold && rate <= quick_contraction && to_spare * rate * residual <= tolerance) return true;
    // Two small corrections in a row, the second hardly smaller, are convergence too: the residual is then at
    // its own round-off.
    return small && last <= tolerance && !contracts(hardly_smaller);
  }
  /// The norm of the last correction, infinite before the first one.
  double last_correction() const { return correction_; }
  /// Whether the last correction was no larger than this part of the one before.
  bool contracts(double to = good_contraction) const { return contraction_ <= to; }

 private:
  static constexpr double hardly_smaller = 0.5;      // contraction of round-off
  static constexpr double quick_contraction = 0.02;  // of both, for a prediction
  static constexpr double quickest_kept = 5e-3;      // quickest rate of a reused matrix that is relied on
  static constexpr double to_spare = 5;              // margin of the predicted residual

  double correction_ = std::numeric_limits<double>::infinity();
  double residual_ = std::numeric_limits<double>::infinity();
  double contraction_ = 0;
};

}  // namespace nurbeam
