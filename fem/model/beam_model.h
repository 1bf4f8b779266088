#pragma once
#include <vector>

#include "fem/forces/force.h"
#include "fem/structure/constraint.h"
#include "fem/structure/structure.h"

namespace nurbeam {

/// All that does not change during a run: the structure, what holds it and what acts on it.
///
/// A plain value; ModelBuilder makes one whose parts fit.
struct BeamModel : Structure {
  std::vector<Constraint> constraints;
  std::vector<Force> forces;
};

}  // namespace nurbeam
