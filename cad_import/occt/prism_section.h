#pragma once
#include <cstddef>
#include <vector>

#include "cad_import/occt/prism_edges.h"
#include "nurbs/area_moments.h"

namespace nurbeam {

/// A closed line in which a plane across a prism cuts its faces [mm].
struct PrismLoop {
  std::vector<std::size_t> edges;        ///< its corners, in order
  std::vector<Eigen::Vector2d> corners;  ///< where they are
  AreaMoments moments;                   ///< of what is inside; the area is positive

  bool surrounds(const Eigen::Vector2d& place) const;  ///< its corners do, joined by lines
};

/// Those of the plane z = `at`, with moments about `origin`.
std::vector<PrismLoop> prism_section(const PrismEdges& prism, double at, const Eigen::Vector2d& origin);

}  // namespace nurbeam
