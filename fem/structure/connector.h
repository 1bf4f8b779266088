#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "fem/structure/grip.h"
#include "fem/structure/home_nodes.h"

namespace nurbeam {

enum class ConnectorType {
  spring,
  tension_only,      ///< a dropper, a rope: slack where it is shorter than its free length
  compression_only,  ///< a buffer
  rod                ///< it keeps its length
};

/// What gives the free length.
enum class ConnectorLength {
  given,
  as_drawn,  ///< that for which the first end stands, in the equilibrium under all loads, where it was drawn
  force      ///< that for which it carries a force in that equilibrium, or as drawn where the run starts so
};

/// Joins two ends: with d from the first to the second and its stretch e = |d| - l_0, or n . d - l_0 along a
/// direction n, it pulls them together with N = k e + c e'.
///
/// Of the types that carry one sign alone, N = max(0, k e + c e') where e > 0, else 0; or the same mirrored.
/// With a damper N jumps where e comes to 0, at which a step ends: State::memory says where one is taut.
struct Connector {
  std::string name;
  std::array<Grip, 2> ends;  ///< a place of a beam keeps its node
  ConnectorType type = ConnectorType::spring;
  double stiffness = 0;                           ///< k [N/m]
  double damping = 0;                             ///< c [N s/m]
  double length = 0;                              ///< l_0 [m]; where it is to be found, that of the drawing
  std::optional<Eigen::Vector3d> direction = {};  ///< n, of unit length
  ConnectorLength length_rule = ConnectorLength::given;
  double force = 0;  ///< with ConnectorLength::force [N]

  /// Of the types that carry one sign: 1 where that is a pull, -1 a push; 0 of the others.
  int sign() const {
    return type == ConnectorType::tension_only ? 1 : type == ConnectorType::compression_only ? -1 : 0;
  }
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    for (const Grip& end : ends)
      if (end.beam >= 0)
        visit(
            end.beam, end.s, [](HomeNode& node) { node.kept = true; });
  }
  bool jumps() const { return sign() != 0 && damping > 0; }
  /// Less is none, where its ends are that far apart [m].
  double least_stretch(double distance) const { return 1e-12 * (std::abs(distance) + std::abs(length)); }
};

}  // namespace nurbeam
