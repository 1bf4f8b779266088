#pragma once
#include <vector>

#include "fem/material/section_stresses.h"
#include "pipelines/section/section_profile.h"
#include "pipelines/section/torsion_constant.h"

namespace nurbeam {

/// Places along the outline and the holes of a profile with the shear stress of St Venant's torsion, found
/// between the middles of the boundary edges of its mesh: 0 at sharp corners that stand out; nearer to sharp
/// re-entrant corners, where the theory's stress is unbounded, than area over perimeter the one at that
/// distance. NaN where `torsion` has no mesh.
std::vector<StressPlace> stress_places(const SectionProfile& profile, const TorsionReport& torsion);

}  // namespace nurbeam
