#pragma once
#include "pipelines/case/parts/grip.h"
#include "pipelines/case/parts/rotation.h"

namespace nurbeam {

/// What holds a rigid body: a support, or a joint with another body, a beam or a point in space.
struct CaseBodyJoint {
  enum class Type { ball, hinge, rigid, universal, cylinder, slide, line } type = Type::ball;
  std::string path, name;
  std::array<CaseGrip, 2> between;                  ///< the first is a body
  std::optional<Eigen::Vector3d> axis = {};         ///< of a hinge, a cylinder or a slide, as drawn
  std::array<Eigen::Vector3d, 2> axes = {};         ///< of a universal joint: of the first, of the second
  std::vector<DisplacementTable::Row> motion = {};  ///< of a support from its drawn place [m]
  std::optional<CaseRotation> rotation = {};        ///< of a support
  std::optional<CaseDrive> drive = {};              ///< of a hinge
  bool is_support = false;
  bool says_type = true;  ///< else of a body that is fixed to a beam

  std::string type_path() const { return says_type ? path + ".type" : path; }
};

/// A force or a moment on a body.
struct CaseBodyLoad {
  std::string path;
  int number = 0;  ///< among the loads of the case
  CaseGrip on;
  bool is_moment = false;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< [N] or [N m]
  bool follower = false;
  TimeTable time;  ///< factor; empty: 1
};

}  // namespace nurbeam
