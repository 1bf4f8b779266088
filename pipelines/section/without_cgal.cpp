#include "pipelines/section/cgal_geometry.h"

namespace nurbeam {

bool has_cgal() { return false; }

std::optional<TriangleMesh> delaunay_mesh(const std::vector<std::vector<Eigen::Vector2d>>&, std::size_t) {
  return {};
}

ClosestPoint closest_place(const BezierPath& path, const Eigen::Vector3d& point) {
  return closest_point(path, point);
}

}  // namespace nurbeam
