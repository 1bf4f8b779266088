#pragma once
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// The largest entry on the diagonal of M(q) at `state`, or 1 when there is none that is positive and finite:
/// what the dynamic rows are divided by so that they stand beside the constraint rows. `kkt` is overwritten.
double mass_scale(const SecondOrderSystem& system, const State& state, SparseValues kkt);

}  // namespace nurbeam
