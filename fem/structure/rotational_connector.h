#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "fem/structure/grip.h"
#include "fem/structure/home_nodes.h"

namespace nurbeam {

/// A connector that resists the turn of its second end against its first: of two rigid bodies or sections of
/// beams with torsion, of two directions of beams without it, or of one of them against space.
///
/// With an axis: phi is the angle by which the second end has turned about the axis since the drawing,
/// counted over full turns. The moment M = k (phi - phi_0) + M_0 + c phi' about the axis acts on the first
/// end, and -M on the second. The axis is fixed in the first end; of directions it is fixed in space. Without
/// an axis: the moment is k theta + c w, with the vector theta of the smallest rotation between the ends,
/// below 180 degrees, and their relative spin w; the ends are bodies and sections.
struct RotationalConnector {
  std::string name;
  std::array<Grip, 2> ends;                  ///< a place of a beam keeps its node; a point stands for space
  std::optional<Eigen::Vector3d> axis = {};  ///< of unit length, as drawn; z in the plane without one
  double stiffness = 0;                      ///< k [N m]
  double damping = 0;                        ///< c [N m s]
  double angle = 0;                          ///< free angle phi_0 [rad]
  double moment = 0;                         ///< M_0, at the free angle [N m]

  template <class Visit>
  void for_each_node(Visit&& visit) const {
    for (const Grip& end : ends)
      if (end.beam >= 0)
        visit(
            end.beam, end.s, [](HomeNode& node) { node.kept = true; });
  }
  /// Whether it counts an angle.
  bool counts(int dimension) const { return axis.has_value() || dimension == 2; }
  /// The elastic part of M at an angle [N m].
  double elastic_moment(double phi) const { return stiffness * (phi - angle) + moment; }
  /// Its energy [J]: above that where it bears no moment, or without a stiffness above that of the free
  /// angle.
  double energy(double phi) const {
    const double M = elastic_moment(phi);
    return stiffness > 0 ? M * M / (2 * stiffness) : moment * (phi - angle);
  }
};

}  // namespace nurbeam
