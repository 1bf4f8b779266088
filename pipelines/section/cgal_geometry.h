#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

/// What CGAL does for nurbeam, and what takes its place in a build without it (NURBEAM_WITH_CGAL=OFF).
namespace nurbeam {

struct TriangleMesh {
  std::vector<Eigen::Vector2d> points;        ///< [m]
  std::vector<std::array<int, 3>> triangles;  ///< anticlockwise
};

/// Whether this build has CGAL.
bool has_cgal();

/// A Delaunay mesh of the region between closed polygons that do not cross: inside an odd number of them,
/// angles from 20.7 degrees on but at smaller corners. The points begin with the corners of the polygons,
/// one after another; polygon edges may be split. Nothing without CGAL, or when it would take more than
/// `most_points`.
std::optional<TriangleMesh> delaunay_mesh(const std::vector<std::vector<Eigen::Vector2d>>& polygons,
                                          std::size_t most_points);

}  // namespace nurbeam
