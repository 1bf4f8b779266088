#include "pipelines/section/cgal_geometry.h"

namespace nurbeam {

bool has_cgal() { return false; }

std::optional<TriangleMesh> delaunay_mesh(const std::vector<std::vector<Eigen::Vector2d>>&, std::size_t) {
  return {};
}

}  // namespace nurbeam
