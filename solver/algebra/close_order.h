#pragma once
#include <optional>
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// The unknowns of a symmetric pattern in the order of their numbers. Unknowns without a coupling near by, as
/// multipliers at the end of all coordinates, follow right after the first unknown with which they are
/// coupled. A component is reversed if its unknowns coupled with those `left_out` are nearer to its start.
/// Unknowns `left_out` are missing.
///
/// Nothing where this band is much wider than the largest number of couplings of one unknown requires. The
/// search looks at each column once, where BandOrder goes over all entries several times.
std::optional<std::vector<int>> close_order(const SparseView& pattern, const std::vector<int>& left_out);

}  // namespace nurbeam
