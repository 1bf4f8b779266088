#pragma once
#include <array>

#include "fem/material/section.h"

namespace nurbeam {

/// The energy that keeps an element from folding inside. The assumed strain does not see the parts e_3 and
/// e_4 of the pointwise strain. Without an energy in them a slack rope would fold within an element, as that
/// costs less than the straight rope under compression. With R the root mean square of what is not seen,
///
///   U = zeta/2 EA l (R - r_0)^2 where R > r_0, else 0;   R^2 = (10/21) e_3^2 + (14/45) e_4^2.
///
/// Below r_0 bending is not hindered: an arc that turns by 145 degrees has R = r_0. A fold to half of |r_s|
/// has 0.235. It costs more than the kinetic energy of the rope up to a speed of 0.13 times that of sound in
/// the rope; motions were tried up to 0.03 times.
struct FoldResistance {
  static constexpr double zeta = 0.5, r_0 = 0.04;
  static constexpr double of_3 = 10. / 21, of_4 = 14. / 45;
};

/// R^2 of FoldResistance.
template <class T>
NURBEAM_WITHIN T squared_residue(const T& e_3, const T& e_4) {
  return FoldResistance::of_3 * (e_3 * e_3) + FoldResistance::of_4 * (e_4 * e_4);
}

/// FoldResistance per length of the element, as functions of (e_3, e_4), times a factor; and the damping of
/// their rates. Its stress is c zeta EA (1 - r_0/R) times the rate, so that it begins at zero.
template <class T>
class FoldStresses {
 public:
  using Pair = std::array<T, 2>;
  using Matrix = std::array<Pair, 2>;

  T energy;          ///< [J/m]
  Pair force;        ///< [N]
  Matrix stiffness;  ///< [N]

  NURBEAM_WITHIN FoldStresses(const BeamProperties& beam, const T& factor, const Pair& e)
      : damping_(beam.damping), scale_(FoldResistance::zeta * beam.axial_stiffness * factor) {
    const T excess = positive(T(square_root(squared_residue(e[0], e[1])) - FoldResistance::r_0));
    const T R = excess + FoldResistance::r_0;
    weighted_ = {FoldResistance::of_3 * e[0], FoldResistance::of_4 * e[1]};
    part_ = excess / R;
    slope_ = FoldResistance::r_0 * (1. - is_zero(excess)) / (R * R * R);
    energy = scale_ / 2 * (excess * excess);
    force = stress(scale_, weighted_);
    stiffness = by_e(scale_, weighted_);
    add_unit(scale_, stiffness);
  }

  /// Damping at these rates of e_3 and e_4: stress [N], and its derivatives by the rates and by (e_3, e_4).
  NURBEAM_WITHIN Pair viscous_force(const Pair& rate) const {
    return stress(damping_ * scale_, {FoldResistance::of_3 * rate[0], FoldResistance::of_4 * rate[1]});
  }
  NURBEAM_WITHIN Matrix viscosity() const {
    Matrix by_rate{Pair{zero<T>(), zero<T>()}, Pair{zero<T>(), zero<T>()}};
    add_unit(damping_ * scale_, by_rate);
    return by_rate;
  }
  NURBEAM_WITHIN Matrix viscous_force_by_e(const Pair& rate) const {
    return by_e(damping_ * scale_, {FoldResistance::of_3 * rate[0], FoldResistance::of_4 * rate[1]});
  }

 private:
  NURBEAM_WITHIN Pair stress(const T& scale, const Pair& weighted) const {
    return {scale * (part_ * weighted[0]), scale * (part_ * weighted[1])};
  }
  // The derivatives of `stress` by (e_3, e_4) through the part alone, d(1 - r_0/R)/de.
  NURBEAM_WITHIN Matrix by_e(const T& scale, const Pair& weighted) const {
    const auto& w = weighted_;
    return {Pair{scale * (slope_ * weighted[0] * w[0]), scale * (slope_ * weighted[0] * w[1])},
            Pair{scale * (slope_ * weighted[1] * w[0]), scale * (slope_ * weighted[1] * w[1])}};
  }
  NURBEAM_WITHIN void add_unit(const T& scale, Matrix& sum) const {
    sum[0][0] += FoldResistance::of_3 * (scale * part_);
    sum[1][1] += FoldResistance::of_4 * (scale * part_);
  }

  double damping_;
  T scale_;
  Pair weighted_;       // dR/de times R
  T part_{}, slope_{};  // 1 - r_0/R, and its derivative by R over R
};

}  // namespace nurbeam
