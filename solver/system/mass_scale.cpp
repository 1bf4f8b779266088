#include "solver/system/mass_scale.h"

#include <cmath>

namespace nurbeam {

double mass_scale(const SecondOrderSystem& system, const State& state, SparseValues kkt) {
  system.tangent(state, {.mass = 1}, kkt);
  double largest = 0;
  for (int i = 0; i < system.coordinate_count(); ++i) largest = std::fmax(largest, kkt.coeff(i, i));
  return largest > 0 && std::isfinite(largest) ? largest : 1;
}

}  // namespace nurbeam
