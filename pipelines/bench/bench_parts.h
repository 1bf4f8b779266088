#pragma once
#include <iosfwd>
#include <vector>

namespace nurbeam {

/// Forces and tangents of single elements, by dimension, damping and ends.
void bench_elements(std::ostream& out);

/// What systems of this many elements, a body sliding on them, cost.
struct SystemCost {
  int elements;
  /// Processor time [s] of one residual, tangent, factorisation, solution, step and change of the mesh, by
  /// one thread.
  double residual, tangent, factorisation, solution, step, event;
  double speed_up;  ///< of a step by the clock: one thread's time over that of one a core
  double memory;    ///< of the system and its integrator [B]
};
std::vector<SystemCost> bench_systems(int largest, std::ostream& out);

}  // namespace nurbeam
