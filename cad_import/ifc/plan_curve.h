#pragma once
#include <Eigen/Core>
#include <vector>

#include "cad_import/ifc/turning.h"
#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// An element of an alignment in plan, by its start and by how its tangent turns from there.
struct PlanElement {
  Eigen::Vector2d start;
  double heading;  ///< of the tangent there [rad]
  double length;
  Turning turning = even_turning(0);

  /// Its place at this arc length from its start.
  Eigen::Vector2d place(double s) const;
};

/// The height over the distance along the plan, from `start` on: with an even slope, or a parabola.
struct GradeElement {
  double start, height, slope;
  double bend = 0;    ///< half of the second derivative of a parabola
  double radius = 0;  ///< of a circular arc, positive where it is a sag; 0: none
};

/// One curve of an alignment and how far it may be from what is meant.
struct AlignmentCurve {
  NurbsCurve curve;
  double deviation = 0;
};

/// The curves of the elements one after another, from this distance on, divided where the grade has another
/// element; in the lengths of the file. Lines of one slope and level arcs are exact, others cubics within
/// `tolerance`.
std::vector<AlignmentCurve> alignment_curves(const std::vector<PlanElement>& plan,
                                             const std::vector<GradeElement>& grade, double begin,
                                             double tolerance);

}  // namespace nurbeam
