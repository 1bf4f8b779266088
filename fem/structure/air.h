#pragma once
#include <Eigen/Core>

namespace nurbeam {

/// The air around a model, everywhere alike.
struct Air {
  double density = 0;                              ///< [kg/m^3]
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  ///< wind velocity [m/s]
};

}  // namespace nurbeam
