#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "fem/system/material_points.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// The chord of a beam, from end to end, and the depth of its elements below it along `gravity`, whose
/// magnitude does not count. Elements are looked at in order.
class Chord {
 public:
  /// `first` and `last`: the control points of the elements at the ends.
  Chord(const Eigen::Matrix4d& first, const Eigen::Matrix4d& last, const Eigen::Vector3d& gravity);

  /// Whether the chord is within about six degrees of gravity. A depth below it says little of the beam then.
  bool is_upright() const { return across_.norm() <= 0.1 * along_.norm(); }
  /// Depth of a point of an element below the chord [m].
  double depth(const RationalCubic& cubic, double u) const;
  /// Looks at the next element.
  void look_at(const Eigen::Matrix4d& control_points);
  /// The element with the lowest middle among those looked at.
  int lowest() const { return lowest_; }

 private:
  Eigen::Vector3d start_, along_, down_, across_;
  int looked_at_ = 0, lowest_ = 0;
  double deepest_ = 0;
};

/// The lowest place: its element, numbered in the beam or in the mesh, and its depth below the chord [m].
struct Lowest {
  int element = 0;
  double u = 0, depth = 0;
};

/// The element with the lowest middle below the chord, which sag() looks at first.
int lowest_element(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity);
/// Sag: the maximum depth of a beam below the straight line between its ends, along `gravity` [m]; 0 where it
/// is nowhere below. NaN without gravity, and where the chord is upright or of no length, as that of a ring.
/// Precondition: there are elements.
double sag(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity);
/// Sag of a beam in a state, and its place, from the spans around `lowest`, the span with the lowest middle,
/// and those at the ends.
Lowest sag_near(const BeamSystem& system, const State& state, int beam, int lowest);
/// Depth of a place of the mesh below the chord [m], 0 where it is not below; NaN in the cases of sag().
double sag_at(const BeamSystem& system, const State& state, int beam, const Lowest& place);

}  // namespace nurbeam
