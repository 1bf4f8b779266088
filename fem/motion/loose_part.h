#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>

namespace nurbeam {

struct MeshedState;

/// What moves furthest in a motion that nothing resists.
struct LoosePart {
  std::string name;
  bool is_body = false;                                 ///< else a beam
  double s = 0;                                         ///< of the beam's node [m]
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< of unit length
};

/// That of a model at rest where it is a mechanism there: one of many equilibria. Sections that turn in their
/// places alone are left out, as nothing else depends on them. Throws Interruption where `interrupted` says
/// so.
std::optional<LoosePart> find_loose_part(const MeshedState& at, const std::function<bool()>& interrupted);

}  // namespace nurbeam
