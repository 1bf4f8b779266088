#pragma once
#include <vector>

#include "fem/motion/frame.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// A place where a frame records position and velocity.
struct ProbePlace {
  int beam;
  double s;  ///< [m]
};

/// x(first), ..., x(first + D - 1) as a vector in space; a planar model lies in the plane z = 0.
template <int D>
Eigen::Vector3d widened(const Eigen::VectorXd& x, int first) {
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  y.head<D>() = x.segment<D>(first);
  return y;
}

/// The beams of a state, in the model's own coordinates.
template <int D>
std::vector<BeamRecord> record_beams(const BeamSystem<D>& system, const State& state);

/// A state with its beams, bodies, probes and energies (dissipated: none), in the model's own coordinates;
/// what is known of steps is left empty.
template <int D>
Frame record_frame(const BeamSystem<D>& system, const State& state, const std::vector<ProbePlace>& probes);

extern template std::vector<BeamRecord> record_beams<2>(const BeamSystem<2>&, const State&);
extern template std::vector<BeamRecord> record_beams<3>(const BeamSystem<3>&, const State&);
extern template Frame record_frame<2>(const BeamSystem<2>&, const State&, const std::vector<ProbePlace>&);
extern template Frame record_frame<3>(const BeamSystem<3>&, const State&, const std::vector<ProbePlace>&);

}  // namespace nurbeam
