#pragma once
#include <TopoDS_Shape.hxx>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cad_import/occt/prism_section.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// A straight hollow bar with plane sides, as a rectangular tube, rounded at its corners or not [mm].
struct HollowBar {
  Eigen::Matrix3d axes;    ///< x, y, z: along the centre line
  Eigen::Vector2d centre;  ///< x, y of the centre line: the centroid of the section
  PrismLoop outline;
  BarSection section;  ///< [m]
  int face;            ///< one of its faces

  /// How it ends: z of the corners of the outline, and where a plane through them cuts the centre line.
  struct End {
    double low, high;
    std::optional<double> cut;
  };
  std::array<End, 2> ends;

  Eigen::Vector3d place(double z) const { return axes * Eigen::Vector3d(centre.x(), centre.y(), z); }
  double size() const;  ///< the larger of width and height
};

/// Those of a shape: prisms whose sections are an outline around holes that are a quarter of it or more, at
/// least as long as they are wide. Faces of no solid, as IGES has them, are sewn. `faces`: of the shape.
std::vector<HollowBar> hollow_bars(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces);

}  // namespace nurbeam
