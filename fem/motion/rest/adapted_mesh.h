#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "fem/model/beam_model.h"

namespace nurbeam {

/// How fine a mesh has been made, and by what it was judged.
struct AdaptedMesh {
  double error = 0;  ///< estimated, of positions over the beam's length, the largest of the beams [-]
  bool from_equilibrium = true;  ///< else the drawn shape was judged: no equilibrium was found
  bool reached = true;           ///< all tolerances; else the number of elements was at its limit
  bool interrupted = false;      ///< the search has been ended
};

/// Divides beams into as many elements as their static state under all loads needs, sliding bodies held where
/// they start: the estimated error of positions over the beam's length is to be within the beam's tolerance.
/// Between two places that no element may cross elements are of one length; beams without tolerance stay as
/// they are. Only refines what is there. `most_elements`: of one beam. `interrupted` is asked at every Newton
/// iteration. `time`: of the loads [s].
///
/// The estimate of a beam is the sum of position_error() over its elements.
AdaptedMesh adapt_mesh(BeamModel& model, const std::vector<std::optional<double>>& tolerances,
                       int most_elements, const std::function<bool()>& interrupted = {}, double time = 0);

}  // namespace nurbeam
