#pragma once
#include <memory>
#include <vector>

#include "fem/motion/rest/resting_place.h"

namespace nurbeam {

/// Whether a connector of the model has a free length that an equilibrium gives.
bool asks_for_lengths(const BeamModel& model);

/// Brings a model to the equilibrium, with all sliding bodies held where they are, in which its connectors
/// have the lengths that their ConnectorLength asks for. The model of `at` then has these lengths as numbers.
///
/// Newton's method on the lengths takes connectors of one sign as springs. A connector that would have to
/// carry the other sign is a failure. `interrupted` is asked at every iteration of the equilibria.
[[nodiscard]] RestReport find_free_lengths(MeshedState& at, const std::function<bool()>& interrupted);

/// The model with these free lengths of its connectors [m].
std::shared_ptr<const BeamModel> with_lengths(const BeamModel& model, const std::vector<double>& lengths);

}  // namespace nurbeam
