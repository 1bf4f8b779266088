#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "fem/system/material_points.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// The straight line between the ends of a beam, and how far its elements, looked at one after the other,
/// hang below it along `gravity`, whose size does not count.
class Chord {
 public:
  /// `first` and `last`: the control points of the elements at the ends.
  Chord(const Eigen::Matrix4d& first, const Eigen::Matrix4d& last, const Eigen::Vector3d& gravity);

  bool is_vertical() const { return across_.norm() <= 1e-9 * std::max(along_.norm(), 1e-300); }
  /// How far a point of an element is below [m].
  double depth(const RationalCubic& cubic, double u) const;
  /// Looks at the next element.
  void look_at(const Eigen::Matrix4d& control_points);
  /// Of the elements so far that whose middle is the lowest.
  int lowest() const { return lowest_; }

 private:
  Eigen::Vector3d start_, along_, down_, across_;
  int looked_at_ = 0, lowest_ = 0;
  double deepest_ = 0;
};

/// A place in the element of that number, of a beam or of the mesh, and how far it is below the chord [m].
struct Lowest {
  int element = 0;
  double u = 0, depth = 0;
};

/// The element whose middle is the lowest so, of those that sag looks at first.
int lowest_element(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity);
/// How far a beam hangs below the straight line between its ends, at most, along `gravity` [m]; 0 where it is
/// nowhere below. NaN without gravity, and where the ends lie above each other, as those of a ring do.
/// Precondition: there are elements.
double sag(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity);
/// The same of a state, and where it is, from the spans around that with the lowest middle, and those at the
/// ends.
Lowest sag_near(const BeamSystem& system, const State& state, int beam, int lowest);
/// At a place of the mesh, 0 where that is not below; NaN as sag.
double sag_at(const BeamSystem& system, const State& state, int beam, const Lowest& place);

}  // namespace nurbeam
