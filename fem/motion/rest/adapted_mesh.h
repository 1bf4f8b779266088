#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "fem/model/beam_model.h"

namespace nurbeam {

/// The result of a mesh adaptation, and the state by which the mesh was judged.
struct AdaptedMesh {
  double error = 0;  ///< estimated error of positions over the beam's length, the maximum of the beams [-]
  bool from_equilibrium = true;  ///< false: the drawn shape was judged, as no equilibrium was found
  bool reached = true;           ///< all tolerances are met; false: the number of elements reached its limit
  bool interrupted = false;      ///< the search was ended by `interrupted`
};

/// Divides beams into as many elements as their static equilibrium under all loads needs, with sliding bodies
/// held where they start. The estimated error of positions over the beam's length must be within the beam's
/// tolerance.
///
/// The mesh is only refined. Between two places that no element may cross elements have one length; beams
/// without tolerance stay as they are. `most_elements`: limit for one beam. `interrupted` is asked at every
/// Newton iteration. `time`: of the loads [s].
///
/// The estimate of a beam is the sum of position_error() over its elements, and of what kinks and clamps miss
/// that stand for layers of bending. Where these miss too much, elements become so short that a slope which
/// is one on both sides misses less; the caller has to make it so.
AdaptedMesh adapt_mesh(BeamModel& model, const std::vector<std::optional<double>>& tolerances,
                       int most_elements, const std::function<bool()>& interrupted = {}, double time = 0);

}  // namespace nurbeam
