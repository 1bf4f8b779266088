#pragma once
#include <optional>

#include "fem/motion/record/snapshot.h"

namespace nurbeam {

/// What a body feels; nothing for a point mass unless BeamModel::accelerations asks for it.
std::optional<FeltRecord> felt_by(const BeamSystem& system, const State& state, int body);

/// What is felt at a place of a beam; nothing unless BeamModel::accelerations asks for it.
std::optional<FeltRecord> felt_at(const BeamSystem& system, const State& state, int beam, double s);

}  // namespace nurbeam
