#pragma once
#include "fem/system/assembly.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Returns visit(assembly) with the Assembly<2> or the Assembly<3> of a system; both calls return one type.
template <class Visit>
auto with_assembly(const BeamSystem& system, Visit&& visit) {
  if (const Assembly<2>* planar = system.assembly<2>()) return visit(*planar);
  return visit(*system.assembly<3>());
}

}  // namespace nurbeam
