#pragma once
#include <array>
#include <vector>

#include "fem/mesh/point_action.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Force [N] and couple [N m] of the part of a beam beyond a section (of greater s) on the part before it.
struct StressResultants {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), couple = Eigen::Vector3d::Zero();
};

/// The stress resultants in one span of the mesh. At its ends they satisfy the equilibrium of its element,
/// with inertia, damping and loads. So they balance reactions, bodies and loads at nodes to round-off.
///
/// Between the ends the couple m is the cubic with m_s = -r_s x n (n the force) at both, which is exact in a
/// straight beam under a constant load; point forces inside are taken out first. Couples are as accurate as
/// positions, of fourth order, where the element's own curvature has second order. Forces between nodes,
/// which follow from the couple's derivative, have third.
class SpanResultants {
 public:
  struct End {
    double s;  ///< [m]
    StressResultants carried;
    Eigen::Vector3d slope;                                        ///< r_s [-]
    Eigen::Vector3d torque_per_length = Eigen::Vector3d::Zero();  ///< of loads, about the tangent [N m/m]
  };
  /// A point action and its position.
  struct Inside {
    PointAction action;
    Eigen::Vector3d place;  ///< [m]
  };
  SpanResultants(const std::array<End, 2>& ends, const std::array<Eigen::Vector3d, 2>& end_places,
                 std::vector<Inside> inside);

  /// Stress resultants at s, where r and r_s are the position and slope. The force has no part along r_s: the
  /// axial force is the element's own.
  StressResultants at(double s, const Eigen::Vector3d& r, const Eigen::Vector3d& slope) const;
  /// The part of the couple that the element's own cubic cannot follow, integrated twice over the span with
  /// no value and no slope at its ends [N m^3]: over EI it is the deflection from the cubic that loads
  /// between the ends give. Of loads that are even along the span, and of point actions inside.
  Eigen::Vector3d couple_integral(double s, const Eigen::Vector3d& slope) const;
  double length() const { return s_[1] - s_[0]; }
  /// The point actions between the ends of the span; resultants jump or have a kink at their places.
  const std::vector<Inside>& inside() const { return inside_; }

 private:
  std::array<double, 2> s_;
  std::array<Eigen::Vector3d, 2> couple_, couple_s_;  // at the ends, without the actions inside
  std::vector<Inside> inside_;
};

/// The stress resultants of the spans of one state, each computed when it is asked for. The state's
/// accelerations and multipliers must belong to it. System and state must outlive this object.
class CarriedBySpans {
 public:
  CarriedBySpans(const BeamSystem& system, const State& state);
  SpanResultants operator[](int span) const;
  /// Whether point actions lie inside the span, between its ends.
  bool has_actions(int span) const;

 private:
  const BeamSystem& system_;
  const State& state_;
  std::vector<PointAction> inside_;     // of spans, in their order
  std::vector<Eigen::Vector3d> loads_;  // per beam
};

}  // namespace nurbeam
