#pragma once
#include <string>

#include "pipelines/papers/papers_run.h"

namespace nurbeam::papers {

/// What the events of a run that removed a node, or moved a body off its node, changed.
struct EventJumps {
  int events = 0;
  double rms_energy = 0, largest_energy = 0;  ///< [J]
  double largest_length = 0;                  ///< of the beam [m]
  double largest_momentum = 0;                ///< of its change beyond the supports' impulse [kg m/s]
};
EventJumps jumps_of(const Run& run);

/// Whether a run ended early, or its energy drifted by more than `bound` [J].
bool destroyed(const Run& run, double bound);

/// The target of the comparison of one mesh: ours at least 5 times smaller than the larger, and never more
/// than the smaller, of all ones and the paper's rule.
bool meets_target(double ours, double all_ones, double paper_rule);

}  // namespace nurbeam::papers
