#include "cad_import/dxf/own_axes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace nurbeam {

Eigen::Vector3d point_at(const DxfEntity& entity, int code) {
  return {entity.number_of(code, 0), entity.number_of(code + 10, 0), entity.number_of(code + 20, 0)};
}

Eigen::Matrix3d own_axes(const DxfEntity& entity) {
  Eigen::Vector3d z(entity.number_of(210, 0), entity.number_of(220, 0), entity.number_of(230, 1));
  if (!(z.norm() > 0)) throw std::runtime_error("its normal has no direction");
  z.normalize();
  const bool near_z = std::abs(z.x()) < 1.0 / 64 && std::abs(z.y()) < 1.0 / 64;
  const Eigen::Vector3d x =
      (near_z ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ()).cross(z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

}  // namespace nurbeam
