#pragma once
#include <Eigen/Core>
#include <TopTools_IndexedMapOfShape.hxx>
#include <array>
#include <map>
#include <vector>

class TopoDS_Face;
class TopoDS_Shape;

namespace nurbeam {

/// A straight edge along the z axis of a prism [mm].
struct PrismEdge {
  Eigen::Vector2d place;  ///< x, y
  double low, high;       ///< z
  std::array<int, 2> faces;
};

/// How a plane across a prism cuts a face of it: in a line, or in an arc.
struct PrismSide {
  Eigen::Vector2d along;           ///< of a line
  Eigen::Vector2d centre, middle;  ///< of an arc
  double radius = 0;               ///< of an arc; 0 for a line
};

/// The straight edges of one direction between planes and cylinders along them.
struct PrismEdges {
  Eigen::Matrix3d axes;  ///< x, y, z
  std::vector<PrismEdge> edges;
  std::map<int, PrismSide> sides;  ///< by the face
};

/// Whether a face is flat, or a cylinder.
bool is_side_of_prism(const TopoDS_Face& face);

/// Those of a solid, by their directions. `faces`: of the shape that it is a part of; they count them,
/// from 1. Of more than 100 directions those that come first.
std::vector<PrismEdges> prism_edges(const TopoDS_Shape& solid, const TopTools_IndexedMapOfShape& faces);

}  // namespace nurbeam
