#pragma once
#include <vector>

#include "fem/system/assembly.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Per element of `to` that of `from`, a system of the same model in another mesh, which is the same: between
/// the same nodes, on the same chart; none where there is no such. Those of beams with torsion may have other
/// charts of their sections.
template <int D>
std::vector<const MeshElement<D>*> same_elements(const Assembly<D>& to, const Assembly<D>& from);

/// By the index of an element of `from` that of the same one of `to`, -1 where there is none.
std::vector<int> kept_elements(const BeamSystem& from, const BeamSystem& to);

/// Unknowns of `to` in whose rows equations that `from` satisfies may be open, its rates carried over: those
/// of elements that `from` has not. Constraints that nodes near there open by their moves are near too. Empty
/// where they may be in all rows: with torsion, or where riders or stops have other modes.
std::vector<int> changed_unknowns(const BeamSystem& from, const BeamSystem& to);

}  // namespace nurbeam
