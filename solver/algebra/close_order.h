#pragma once
#include <optional>
#include <vector>

#include "solver/algebra/sparse_pattern.h"

namespace nurbeam {

/// The unknowns of a symmetric pattern as they are numbered, but those that are coupled with none near by
/// right after the first that they are coupled with, as multipliers at the end of all coordinates are. A
/// component whose unknowns coupled with those `left_out` are nearer to its start is turned round. All but
/// those `left_out`; nothing where that makes a band much wider than the most that one unknown is coupled
/// with asks for. Takes a look at each column, where BandOrder walks over all entries several times.
std::optional<std::vector<int>> close_order(const SparseView& pattern, const std::vector<int>& left_out);

}  // namespace nurbeam
