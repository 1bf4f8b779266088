#pragma once
#include <span>
#include <vector>

#include "nurbs/nurbs_curve.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// A place where consecutive cubics meet at an angle.
struct Corner {
  int after_segment;      ///< the corner lies between this segment and the next (0-based)
  Eigen::Vector3d point;  ///< [m]
  double angle;           ///< between the two tangents [rad]
};

/// The places where the tangent turns by more than `angle` [rad] from one segment to the next.
std::vector<Corner> corners_of(std::span<const RationalCubic> segments, double angle);

/// Total length of cubics [m], to a relative error of about 1e-13.
double total_length(std::span<const RationalCubic> segments);

/// Cubics in order, their break parameters in the source, and a bound on the deviation from it.
///
/// Consecutive segments share their end points (to the source's own accuracy). What needs no breaks (lengths,
/// corners, closest points) takes the cubics alone; what needs them asks for one more than segments.
struct BezierPath {
  std::vector<RationalCubic> segments;
  std::vector<double> breaks;  ///< segments.size() + 1 parameters in the source curve, increasing
  double deviation = 0;        ///< bound on the distance from the source [m]; 0 where the conversion is exact

  /// Knot insertion to full multiplicity, degree elevation in homogeneous coordinates: exact (1e-15) up to
  /// degree 3. Above, C1 Hermite interpolation in homogeneous coordinates on intervals each as long as the
  /// tolerance [m] allows, across the source's knots but for those where it is only C0; the deviation is
  /// proven, at equal parameters, from Bezier points of the difference. Throws std::invalid_argument for
  /// tolerance <= 0 when degree > 3. A tolerance below 1e-14 of the coordinates' size is taken as that;
  /// `deviation` tells what was reached. Every rational piece that turns by more than 90 degrees is split
  /// until it does not (a cusp: ten times).
  static BezierPath from_nurbs(const NurbsCurve& curve, double tolerance);

  /// One cubic NURBS curve through all segments with triple interior knots at `breaks`, segment weights
  /// rescaled by sigma_{j+1} = sigma_j w3_j / w0_{j+1} so that shared control points agree. Lossless.
  NurbsCurve to_nurbs() const;

  double length() const { return total_length(segments); }
  std::vector<Corner> corners(double angle) const { return corners_of(segments, angle); }
};

}  // namespace nurbeam
