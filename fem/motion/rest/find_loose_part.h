#pragma once
#include <functional>
#include <optional>

#include "fem/motion/record/loose_part.h"
#include "fem/motion/remesh/meshed_state.h"

namespace nurbeam {

/// The loose part of a model at rest that is a mechanism there, with one of many equilibria. Sections that
/// only turn in their places are left out, as nothing else depends on them. Throws Interruption where
/// `interrupted` returns true.
std::optional<LoosePart> find_loose_part(const MeshedState& at, const std::function<bool()>& interrupted);

/// The part that moves furthest in the motion that nothing holds, where the tangent is singular; nothing
/// elsewhere.
std::optional<LoosePart> find_free_part(const MeshedState& at);

}  // namespace nurbeam
