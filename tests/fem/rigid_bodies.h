#pragma once
#include <Eigen/Geometry>

#include "fem/model/build.h"
#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "tests/fem/random_models.h"

/// Rigid bodies, and states of them.
namespace nurbeam::testing {

inline const Eigen::Vector3d tumbling_at(0.1, 0.2, -0.3);

/// A matrix that a body can have.
inline Eigen::Matrix3d general_inertia() {
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -1, 2).normalized()).toRotationMatrix();
  return axes * Eigen::Vector3d(0.8, 1.3, 1.7).asDiagonal() * axes.transpose();
}
inline int add_tumbling_body(ModelBuilder& builder, const std::string& name = "tumbling",
                             const Eigen::Vector3d& at = tumbling_at) {
  return builder.add_rigid_body(name, 2.5, general_inertia(), at);
}

inline void put(const BeamSystem& system, State& state, int body, const Eigen::Vector3d& r,
                const Eigen::Quaterniond& turn) {
  state.q.segment<3>(system.mesh().bodies[body]) = r;
  state.q.segment<4>(system.mesh().attitudes[body]) << turn.w(), turn.vec();
}

/// Attitudes of any length, and everything in motion.
inline State general_state(const BeamSystem& system, std::mt19937& random) {
  State state = disturbed_state(system, random);
  for (const int p : system.mesh().attitudes)
    if (p >= 0) state.q.segment<4>(p) = random_vector(4, random);
  return state;
}

}  // namespace nurbeam::testing
