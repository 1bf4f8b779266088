#pragma once
#include <optional>
#include <string>

#include "fem/model/beam_model.h"
#include "fem/motion/record/snapshot.h"

namespace nurbeam {

/// The largest stress of a run that no material bears: more than a fiftieth of Young's modulus.
struct HighStress {
  double value = 0;    ///< [Pa]; 0: none
  double modulus = 0;  ///< Young's modulus of the beam [Pa]
  std::string beam;
  double s = 0, time = 0;            ///< [m], [s]
  std::optional<double> layer = {};  ///< Extreme::layer [m]

  void look_at(const Snapshot& frame, const BeamModel& model);
};

/// The first kink of a run at which a beam is not under tension: it has no layer of bending there.
struct SlackKink {
  std::string beam;        ///< "": none
  double s = 0, time = 0;  ///< [m], [s]

  void look_at(const Snapshot& frame, const BeamModel& model);
};

}  // namespace nurbeam
