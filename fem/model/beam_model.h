#pragma once
#include <vector>

#include "fem/forces/force.h"
#include "fem/structure/constraint.h"
#include "fem/structure/measure.h"
#include "fem/structure/structure.h"

namespace nurbeam {

/// A model: all that does not change during a run, which is the structure, its constraints and its
/// forces, and what is measured of its shape.
///
/// A plain value; ModelBuilder makes one whose parts fit.
struct BeamModel : Structure {
  std::vector<Constraint> constraints;
  std::vector<Force> forces;
  std::vector<Measure> measures;
  bool accelerations = false;  ///< records tell those of point masses and of probes too
};

}  // namespace nurbeam
