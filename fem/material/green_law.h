#pragma once
#include "fem/material/axial_point.h"

namespace nurbeam {

/// Force proportional to the Green strain, psi = EA strain^2/2: the law of the source papers. EA [N] refers
/// to the drawn length (BeamProperties::with_free_stretch).
struct GreenLaw {
  template <class T>
  NURBEAM_WITHIN AxialPoint<T> operator()(double EA, const T& strain, double) const {
    return {EA / 2 * (strain * strain), EA * strain, filled<T>(EA)};
  }
  bool operator==(const GreenLaw&) const = default;
};

}  // namespace nurbeam
