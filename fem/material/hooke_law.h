#pragma once
#include "fem/material/axial_point.h"

namespace nurbeam {

/// Force proportional to the engineering strain, F = EA e. K = d2(psi)/d(eps)2 [N] is the stiffness of the
/// free beam per drawn length, the EA of BeamProperties; then F = K lambda_0^3 e.
struct HookeLaw {
  template <class T>
  AxialPoint<T> operator()(double K, const T& strain, double free) const {
    const double EA = K * std::pow(1 + 2 * free, 1.5);
    return of_engineering_strain(strain, free, [EA](const T& e) {
      return AxialPoint<T>{EA / 2 * (e * e), EA * e, filled<T>(EA)};
    });
  }
  bool operator==(const HookeLaw&) const = default;
};

}  // namespace nurbeam
