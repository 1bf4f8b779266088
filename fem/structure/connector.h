#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "fem/material/force_rows.h"
#include "fem/structure/grip.h"
#include "fem/structure/home_nodes.h"

namespace nurbeam {

enum class ConnectorType {
  spring,
  tension_only,      ///< a dropper, a rope: slack where it is shorter than its free length
  compression_only,  ///< a buffer
  rod                ///< a rod keeps its length
};

/// The rule that gives the free length.
enum class ConnectorLength {
  given,
  /// The free length for which the first end lies where it was drawn, in the equilibrium under all loads.
  as_drawn,
  /// The free length for which the connector carries `force` in the equilibrium under all loads, or in the
  /// drawing where the run starts as drawn.
  force
};

/// A connector joins two ends. Let d be the vector from the first end to the second.
/// The stretch is e = |d| - l_0, or n . d - l_0 along a direction n. The ends are pulled together with
/// N = F(e) + c e', where F = k e or a law by rows, with F(0) = 0.
///
/// Types that carry one sign alone: tension_only has N = max(0, F(e) + c e') where e > 0, else 0;
/// compression_only is its mirror image. With a damper N jumps where e comes to 0, and a step ends there:
/// State::memory tells which connectors are taut.
struct Connector {
  std::string name;
  std::array<Grip, 2> ends;  ///< a place of a beam keeps its node
  ConnectorType type = ConnectorType::spring;
  double stiffness = 0;  ///< k; of a law by rows dF/de where the stretch is 0 [N/m]
  std::optional<ForceRows> rows = {};
  double damping = 0;  ///< c [N s/m]
  /// Free length l_0 [m]; where it is to be found, its value in the drawing.
  double length = 0;
  std::optional<Eigen::Vector3d> direction = {};  ///< n, of unit length
  ConnectorLength length_rule = ConnectorLength::given;
  double force = 0;  ///< for ConnectorLength::force [N]

  /// 1 for a type that only pulls, -1 for one that only pushes, 0 for the others.
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
  /// The elastic law at a stretch [m]: energy [J], force [N] and stiffness [N/m].
  ForceRows::Point elastic(double stretch) const {
    if (rows) return rows->at(stretch);
    return {stiffness * stretch * stretch / 2, stiffness * stretch, stiffness};
  }
  /// The stretch under a force [N], of a spring without damping [m].
  double stretch_under(double pull) const { return rows ? rows->stretch(pull) : pull / stiffness; }
  bool jumps() const { return sign() != 0 && damping > 0; }
  /// A stretch below this counts as zero, for ends at this distance [m].
  double least_stretch(double distance) const { return 1e-12 * (std::abs(distance) + std::abs(length)); }
};

}  // namespace nurbeam
