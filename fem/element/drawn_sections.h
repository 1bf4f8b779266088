#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "fem/element/orientation.h"
#include "nurbs/gauss_panels.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// The section of a drawing at one place: a right-handed triad, and its changes along the drawing.
struct DrawnSection {
  Eigen::Vector3d d1, d2, t;
  Eigen::Vector3d curvature;  ///< t x dt/ds [1/m]
  double twist;               ///< d1' . d2, turn about t per length [rad/m]
};

/// A drawn section with its curvature and twist: values with their first and second derivatives by s.
struct DrawnSectionSeries {
  std::array<Eigen::Vector3d, 3> d1, d2, t;
  std::array<double, 3> k1, k2;  ///< curvature about d1 and d2 [1/m]
  std::array<double, 3> twist;   ///< [rad/m]
};

/// Rule::start is parallel transport along each segment (Bishop's frame): the smallest rotation from the
/// start of a piece, turned by the integral of transport_rate, to about 1e-13 rad. From segment to segment,
/// over small angles and corners alike, the frame turns by the smallest rotation between the two tangents. On
/// a closed curve the frame comes back turned by the holonomy, which is taken out evenly along the curve.
class DrawnSections {
 public:
  /// `breaks`: arc lengths of the ends of the segments.
  /// Throws std::invalid_argument, with the place, where the orientation has no meaning: along `up`; for
  /// `frenet` without curvature (below 1e-6 over the length) or where the curvature's direction jumps by an
  /// angle from segment to segment; for rows of the twist that do not increase; and for a twist that does not
  /// close on a closed curve.
  DrawnSections(const std::vector<RationalCubic>& segments, const std::vector<double>& breaks, bool closed,
                Orientation orientation);

  /// The section in segment j, given again with its number, at its parameter u, which is the arc length s.
  DrawnSection at(const RationalCubic& segment, int j, double u, double s) const;
  DrawnSectionSeries series(const RationalCubic& segment, int j, double u, double s) const;
  /// The integral of the twist between two arc lengths has two parts: the turn by the rule, over the part
  /// [u_0, u_1] of segment j, and the added turn.
  double rule_turn(const RationalCubic& segment, int j, double u_0, double u_1) const;
  double added_turn(double s_0, double s_1) const { return added_turn(s_1).angle - added_turn(s_0).angle; }
  /// Whether the rule turns sections at all.
  bool turns_by_rule() const { return orientation_.rule != Orientation::Rule::start; }
  /// The angle by which parallel transport along a closed curve comes back turned [rad]; 0 on an open one.
  double holonomy() const { return holonomy_; }

 private:
  // A piece of a segment: the parameter where it starts, and the transported frame there.
  struct Piece {
    double u;
    Eigen::Vector3d t, d1;
  };
  // A turn of a section about its tangent, with its rate and two derivatives of the rate.
  struct Turn {
    double angle;
    std::array<double, 3> rate;
  };
  void transport(const std::vector<RationalCubic>& segments, const Eigen::Vector3d& start);
  void check(const std::vector<RationalCubic>& segments, const std::vector<double>& breaks) const;
  Eigen::Vector3d transported(const RationalCubic& segment, int j, double u, const Eigen::Vector3d& t) const;
  Turn added_turn(double s) const;
  template <class T>
  T rule_twist(const RationalCubic& segment, const T& u) const;
  double twist_by_parameter(const RationalCubic& segment, double u) const;
  void check_twist(bool closed) const;

  Orientation orientation_;
  std::vector<double> slopes_;              // slopes of the twist at its rows
  std::vector<std::vector<Piece>> pieces_;  // per segment, with Rule::start
  double length_, holonomy_ = 0;
  std::vector<Panels> turns_;  // turn by the rule, per segment, for other rules
};

}  // namespace nurbeam
