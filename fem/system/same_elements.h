#pragma once
#include <vector>

#include "fem/system/assembly.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Per element of `to`: the same element of `from`, a system of the same model in another mesh; null where
/// there is none. The same element is between the same nodes and on the same chart; with torsion it may have
/// other charts of its sections.
template <int D>
std::vector<const MeshElement<D>*> same_elements(const Assembly<D>& to, const Assembly<D>& from);

/// Per element of `from`: the index of the same element of `to`, -1 where there is none.
std::vector<int> kept_elements(const BeamSystem& from, const BeamSystem& to);

/// Unknowns of `to` whose rows may be out of balance when a motion that `from` satisfies is carried over:
/// those of elements that `from` does not have. Constraints that moves of nodes there open are near too.
/// Empty where all rows may be open: with torsion, or where riders or stops have other modes.
std::vector<int> changed_unknowns(const BeamSystem& from, const BeamSystem& to);

}  // namespace nurbeam
