#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbeam {

/// The residuals and corrections of one step, each with what the last correction left of the one before.
class Convergence {
 public:
  static constexpr double good_contraction = 0.1;  ///< of the corrections, for which a matrix is kept

  /// Takes the norm of a residual and of the correction that answered it; both have one tolerance.
  bool reached(double residual, double correction, double tolerance) {
    contraction_ = correction / correction_;
    const double last = correction_, balance = residual / residual_;
    correction_ = correction;
    residual_ = residual;
    const bool small = correction <= tolerance;
    if (!std::isfinite(last)) return false;
    // Where forces are in balance, one more correction takes what is left; what would be left of that is
    // foretold by the last two.
    const bool foretold = contracts() && contraction_ * correction <= tolerance;
    if (residual <= tolerance && (small || foretold)) return true;
    // Where both are quickly brought down, the balance is foretold as well, with much to spare: no quicker
    // than a kept matrix does it, whatever its first correction has done.
    const double rate = std::max({balance, contraction_, quickest_kept});
    if (foretold && rate <= quick_contraction && to_spare * rate * residual <= tolerance) return true;
    // Two small ones running of which the second is hardly smaller are convergence too: the residual then
    // sits on its own round-off.
    return small && last <= tolerance && !contracts(hardly_smaller);
  }
  /// The norm of the last one, without bound before the first.
  double last_correction() const { return correction_; }
  /// Whether the last correction was no larger than this part of the one before.
  bool contracts(double to = good_contraction) const { return contraction_ <= to; }

 private:
  static constexpr double hardly_smaller = 0.5;      // contraction of what is round-off
  static constexpr double quick_contraction = 0.02;  // of both, which foretells the next ones
  static constexpr double quickest_kept = 5e-3;      // by a matrix that is kept, which is relied on
  static constexpr double to_spare = 5;              // of what is foretold so

  double correction_ = std::numeric_limits<double>::infinity();
  double residual_ = std::numeric_limits<double>::infinity();
  double contraction_ = 0;
};

}  // namespace nurbeam
