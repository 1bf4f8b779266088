#pragma once

namespace nurbeam {

/// What a run can be asked for.
constexpr int most_elements = 100'000;  ///< of one beam
constexpr int most_frames = 1'000'000;
constexpr double most_steps = 1e9;

}  // namespace nurbeam
