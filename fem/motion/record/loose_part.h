#pragma once
#include <Eigen/Core>
#include <string>

namespace nurbeam {

/// The loose part: the beam or body that moves furthest in a motion that nothing resists.
struct LoosePart {
  std::string name;
  bool is_body = false;                                 ///< false: a beam
  double s = 0;                                         ///< place of the beam's node [m]
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< of unit length
};

}  // namespace nurbeam
