#pragma once
#include <pybind11/pybind11.h>

#include <tuple>
#include <vector>

#include "pipelines/model/build_model.h"

namespace nurbeam::python {

/// Python's functions that a model is made with: forces, of which there is one for each law of the case, and
/// motions; and the signal of its wind, one or none.
using Functions = std::tuple<std::vector<pybind11::function>, std::vector<pybind11::function>,
                             std::vector<pybind11::function>>;

/// The model of a case with the forces and the motions by Python's functions.
///
/// A force takes the time [s] and, as arrays in world coordinates, positions [m] and velocities [m/s] of its
/// points, (3) of one point, else (points x 3). It returns the forces [N] in the same shape, or these with
/// their derivatives by positions and velocities, (3 points x 3 points) [N/m], [N s/m]. A motion takes the
/// time and returns the reference arc length of a sliding joint [m] or the displacement of a support (3) [m],
/// alone or with its first two derivatives. A signal in the place of a function is the force itself, or the
/// speed of the joint or the support. With a signal as the wind, bodies feel it in place of that of the case;
/// the work that it does is then booked as that of a force. What functions raise ends the call that has led
/// to it. The model borrows the functions: as long as it is asked for forces somebody must keep them. Throws
/// std::invalid_argument where there are not the functions that the case has use for, and
/// pybind11::error_already_set of a ValueError where a body's motion does not begin where the body is, or a
/// support's not at its drawn place though the run does.
BeamModel with_laws(const BuiltModel& built, const Functions& functions, const CaseAnalysis& analysis);

/// `owner`, an object of Python with attributes of its own, which keeps the functions of its model as one of
/// them: there the garbage collector sees them, also where they refer back to it.
pybind11::object keeping(const pybind11::object& functions, pybind11::object owner);

}  // namespace nurbeam::python
