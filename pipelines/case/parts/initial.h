#pragma once
#include "pipelines/case/fields.h"

namespace nurbeam {

/// How a beam moves at time 0; in world coordinates.
struct CaseVelocity {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     ///< [rad/s]
  Eigen::Vector3d about = Eigen::Vector3d::Zero();        ///< [m]
  double along = 0;                                       ///< of the material along the axis [m/s]
};

inline Fields<CaseVelocity> velocity_fields() {
  using namespace shapes;
  using V = CaseVelocity;
  return {{
      field(&V::translation, "translation", vector(Dimension::speed, plausible(-1e9, 1e9)),
            "of the whole beam"),
      field(&V::rotation, "rotation", vector(Dimension::angular_speed, plausible(-1e9, 1e9)),
            "angular velocity of the whole beam"),
      field(&V::about, "about", point(), "a point of the axis of the rotation; the origin when omitted")
          .beside("rotation"),
      field(&V::along, "along", quantity(Dimension::speed, plausible(-1e9, 1e9)),
            "of the material along the axis, towards its end"),
  }};
}

}  // namespace nurbeam
