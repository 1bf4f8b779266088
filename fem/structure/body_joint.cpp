#include "fem/structure/body_joint.h"

#include <Eigen/Geometry>

#include "fem/structure/structure.h"

namespace nurbeam {

std::vector<AxisPair> hinge_pairs(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d u = axis.normalized(), v = u.unitOrthogonal();
  return {{u, v}, {u, u.cross(v)}};
}

std::vector<AxisPair> rigid_pairs() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  return {{x, y}, {y, z}, {z, x}};
}

std::vector<AxisPair> followed_pairs(const Structure& structure, const Rider& rider) {
  const DrawnSection section = structure.beam_of(rider).curve.section(rider.s);
  Eigen::Matrix3d axes;
  axes << section.d1, section.d2, section.t;
  const Eigen::Quaterniond back = structure.bodies[structure.turning_body(rider)].rigid->attitude.conjugate();
  std::vector<AxisPair> pairs = rider.follows == Follows::section ? rigid_pairs()
                                : rider.follows == Follows::axis  ? hinge_pairs(rider.follow_axis)
                                                                  : hinge_pairs(section.t);
  for (auto& [of_section, of_body] : pairs) {
    of_section = axes.transpose() * of_section;
    of_body = back * of_body;
  }
  return pairs;
}

std::string BodyJoint::reaction_name(const Structure& structure) const {
  return name.empty() ? "reaction." + structure.bodies[point].name : name;
}

int BodyJoint::turning_body(const Structure& structure) const {
  const Body& body = structure.bodies[point];
  return body.point_of ? body.point_of->body : point;
}

}  // namespace nurbeam
