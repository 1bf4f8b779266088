#pragma once
#include <pybind11/pybind11.h>

#include <vector>

#include "pipelines/model/build_model.h"

namespace nurbeam::python {

/// The model of a case with the forces by Python's functions, of which there is one for each law of the case.
///
/// A function takes the time [s] and, as arrays in world coordinates, positions [m] and velocities [m/s] of
/// its points, (3) of one point, else (points x 3). It returns the forces [N] in the same shape, or these
/// with their derivatives by positions and velocities, (3 points x 3 points) [N/m], [N s/m]. What it raises
/// ends the call that has led to it. Throws std::invalid_argument where there are not as many functions as
/// laws.
BeamModel with_laws(const BuiltModel& built, const std::vector<pybind11::function>& functions);

}  // namespace nurbeam::python
