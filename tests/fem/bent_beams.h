#pragma once
#include "fem/model/build.h"
#include "tests/fem/torsion_models.h"

/// Beams and guides that are bent as drawn, of one rational cubic about 1.8 m long: elements on it hold every
/// affine image of it.
namespace nurbeam::testing {

inline RationalCubic bent_cubic(int dimension) {
  const double up = dimension == 3 ? 0.3 : 0;
  Eigen::Matrix4d points;  // homogeneous, a column each
  points.col(0) = Eigen::Vector4d(0, 0, 0, 1);
  points.col(1) = 1.4 * Eigen::Vector4d(0.5, 0.4, up, 1);
  points.col(2) = 0.8 * Eigen::Vector4d(1.2, 0.5, -up, 1);
  points.col(3) = Eigen::Vector4d(1.6, 0, 0, 1);
  return RationalCubic(points);
}

inline ReferenceCurve bent_axis(int dimension) { return ReferenceCurve({bent_cubic(dimension)}, dimension); }

inline int add_bent_beam(ModelBuilder& builder, int dimension, int elements = 8) {
  return builder.add_beam(bent_axis(dimension), BeamProperties(300, 2, 0.7), {elements});
}

/// With torsion: its sections turn along it as drawn.
inline int add_twisted_beam(ModelBuilder& builder, int elements = 6) {
  return builder.add_beam(
      bent_axis(3).oriented({Orientation::Rule::start, {0.3, 0.2, 1}, {{0, 0}, {1, 0.7}, {4, 2}}}),
      with_sections(), {elements});
}

/// From the end of the bent axis on, about 1.3 m in another direction.
inline RationalCubic going_on(int dimension) {
  const double up = dimension == 3 ? 0.4 : 0;
  Eigen::Matrix4d points;
  points.col(0) = Eigen::Vector4d(1.6, 0, 0, 1);
  points.col(1) = 0.9 * Eigen::Vector4d(1.7, 0.5, up, 1);
  points.col(2) = 1.2 * Eigen::Vector4d(1.5, 0.9, up, 1);
  points.col(3) = Eigen::Vector4d(1.8, 1.2, up / 2, 1);
  return RationalCubic(points);
}

}  // namespace nurbeam::testing
