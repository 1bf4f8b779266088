#pragma once
#include <vector>

#include "pipelines/section/profile_polygon.h"

namespace nurbeam {

struct TorsionOptions {
  double relative_error = 1e-6;  ///< wanted, of the constant
  int most_points = 20'000;      ///< corners of triangles
};

enum class TorsionStatus {
  done,
  coarse,  ///< `most_points` did not suffice: `error` is what was reached
  no_mesh  ///< no CGAL in this build, or `most_points` do not suffice for a mesh
};

/// The torsion constant of St Venant: torque per shear modulus and rate of twist.
struct TorsionReport {
  TorsionStatus status = TorsionStatus::no_mesh;
  double value = 0;  ///< J [m^4]
  double error = 0;  ///< J lies within value +- error, up to the shape of the mesh's boundary [m^4]
  int points = 0;    ///< corners of triangles in the last mesh
  /// The shear stress at the middles of the boundary edges of that mesh.
  struct AtBoundary {
    int loop, segment;
    double u;      ///< on the segment
    double shear;  ///< over shear modulus and rate of twist: times torque/J it is the stress [m]
  };
  std::vector<AtBoundary> boundary = {};
  /// From the origin, which must be the centroid [m].
  Eigen::Vector2d shear_centre = Eigen::Vector2d::Zero();
  /// Of the warping about the shear centre: with E the stiffness against its change along the beam [m^6].
  double warping_constant = 0;
};

/// Torsion constant of the region between closed paths in the plane z = 0: an outline that runs
/// anticlockwise and holes that run clockwise, none of them crossing.
///
/// Isoparametric quadratic triangles on a CGAL Delaunay mesh, bisected where that is needed. Two solutions on
/// the same mesh bound J: Prandtl's stress function (-lap phi = 2 inside, phi = 0 on the outline and constant
/// on each hole) from below, the warping function (lap psi = 0) from above. What lies between them is
/// the integral of the squared difference of their stresses, (psi_x - y, psi_y + x) and (phi_y, -phi_x)
/// (Prager and Synge 1947), which also says where to refine. The area between curve and mesh boundary, times
/// the square of the stress there (Hadamard), is added to the error.
TorsionReport torsion_constant(const std::vector<Loop>& loops, const TorsionOptions& options = {});

}  // namespace nurbeam
