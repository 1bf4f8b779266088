#pragma once
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// The largest entry on the diagonal of M(q) at `state`, or 1 if none is positive and finite. The dynamic
/// rows are divided by it, so that they compare with the constraint rows. `kkt` is overwritten.
double mass_scale(const SecondOrderSystem& system, const State& state, SparseValues kkt);

}  // namespace nurbeam
