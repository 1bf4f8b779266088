#pragma once
#include "fem/material/numbers.h"

namespace nurbeam {

/// The axial law at a point, by the Green strain eps: energy per reference length psi [J/m], d(psi)/d(eps)
/// [N] and d2(psi)/d(eps)2 [N]. The axial force is d(psi)/d|r_s| = d(psi)/d(eps) |r_s|.
template <class T>
struct AxialPoint {
  T energy, force, stiffness;
};

/// The axial law F(e) [N] of the engineering strain e = |r_s|/lambda_0 - 1 and its energy W(e) = int F de
/// [J/m], as an AxialPoint. `strain` is eps less the free strain (lambda_0^2 - 1)/2. A section that is
/// compressed to less than a tenth of its length keeps the force and the stiffness of that length. So |r_s| =
/// 0 is no singular point.
///
///   r^2 = 1 + 2 strain/lambda_0^2,  e = r - 1,  psi = lambda_0 W,  psi' = F/(lambda_0 r),
///   psi'' = (F' - F/r)/(lambda_0^3 r^2)
///
/// `law(e)` returns {W, F, F'}.
template <class T, class Law>
AxialPoint<T> of_engineering_strain(const T& strain, double free, const Law& law) {
  constexpr double least = 0.1;
  const double square = 1 + 2 * free, natural = std::sqrt(square);
  const T below = positive(T(square * (least * least - 1) / 2 - strain));
  const T held = strain + below, r = square_root(T(1. + 2. / square * held));
  const AxialPoint<T> by_e = law(T(r - 1.));
  const T force = 1 / natural * by_e.force / r;
  const T stiffness = 1 / (natural * square) * (by_e.stiffness - by_e.force / r) / (r * r);
  return {natural * by_e.energy - (force - 0.5 * (stiffness * below)) * below, force - stiffness * below,
          stiffness};
}

}  // namespace nurbeam
