#include "cad_import/occt/prism_edges.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Geometry>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <gp_Cylinder.hxx>
#include <gp_Lin.hxx>
#include <gp_Pln.hxx>
#include <optional>

#include "cad_import/occt/pipe_wall.h"

namespace nurbeam {
namespace {

constexpr double parallel_within = 1e-6;  // [rad]

Eigen::Vector3d vector_of(const gp_XYZ& xyz) { return {xyz.X(), xyz.Y(), xyz.Z()}; }

Eigen::Matrix3d axes_along(const Eigen::Vector3d& z) {
  Eigen::Matrix3d axes;
  const Eigen::Vector3d x = z.unitOrthogonal();
  axes << x, z.cross(x), z;
  return axes;
}

/// Nothing for one that is neither a plane nor a cylinder along these axes.
std::optional<PrismSide> side_of(const TopoDS_Face& face, const Eigen::Matrix3d& axes) {
  const BRepAdaptor_Surface surface(face, /*restriction=*/false);
  const auto across = [&](const gp_XYZ& xyz) -> Eigen::Vector2d {
    return (axes.transpose() * vector_of(xyz)).head<2>();
  };
  if (surface.GetType() == GeomAbs_Plane) {
    const Eigen::Vector2d normal = across(surface.Plane().Axis().Direction().XYZ());
    return PrismSide{{-normal.y(), normal.x()}, {}, {}};
  }
  if (surface.GetType() != GeomAbs_Cylinder) return std::nullopt;
  const gp_Cylinder cylinder = surface.Cylinder();
  if (vector_of(cylinder.Axis().Direction().XYZ()).cross(axes.col(2)).norm() > parallel_within)
    return std::nullopt;
  const Bounds b = bounds_of(face);
  return PrismSide{{},
                   across(cylinder.Location().XYZ()),
                   across(surface.Value((b.u0 + b.u1) / 2, (b.v0 + b.v1) / 2).XYZ()),
                   cylinder.Radius()};
}

class EdgesByDirection {
 public:
  explicit EdgesByDirection(const TopTools_IndexedMapOfShape& faces) : faces_(faces) {}

  void add(const TopoDS_Edge& edge, const TopoDS_Shape& one, const TopoDS_Shape& other) {
    const BRepAdaptor_Curve curve(edge);
    if (curve.GetType() != GeomAbs_Line) return;
    const Eigen::Vector3d start = vector_of(curve.Value(curve.FirstParameter()).XYZ()),
                          end = vector_of(curve.Value(curve.LastParameter()).XYZ());
    PrismEdges* const group = group_of(vector_of(curve.Line().Direction().XYZ()));
    if (!group) return;
    const std::array<int, 2> faces{faces_.FindIndex(one), faces_.FindIndex(other)};
    if (!know_side(faces[0], *group) || !know_side(faces[1], *group)) return;
    const Eigen::Vector3d a = group->axes.transpose() * start, b = group->axes.transpose() * end;
    group->edges.push_back({(a + b).head<2>() / 2, std::min(a.z(), b.z()), std::max(a.z(), b.z()), faces});
  }

  std::vector<PrismEdges> groups() && { return std::move(groups_); }

 private:
  PrismEdges* group_of(const Eigen::Vector3d& direction) {
    constexpr std::size_t most = 100;
    for (PrismEdges& group : groups_)
      if (group.axes.col(2).cross(direction).norm() <= parallel_within) return &group;
    if (groups_.size() == most) return nullptr;
    groups_.push_back({axes_along(direction), {}, {}});
    return &groups_.back();
  }

  bool know_side(int face, PrismEdges& group) const {
    if (face == 0) return false;
    if (group.sides.contains(face)) return true;
    const std::optional<PrismSide> side = side_of(TopoDS::Face(faces_(face)), group.axes);
    if (side) group.sides.emplace(face, *side);
    return side.has_value();
  }

  const TopTools_IndexedMapOfShape& faces_;
  std::vector<PrismEdges> groups_;
};

}  // namespace

std::vector<PrismEdges> prism_edges(const TopoDS_Shape& solid, const TopTools_IndexedMapOfShape& faces) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edges;
  TopExp::MapShapesAndAncestors(solid, TopAbs_EDGE, TopAbs_FACE, faces_of_edges);
  EdgesByDirection all(faces);
  for (int i = 1; i <= faces_of_edges.Extent(); ++i) {
    const TopTools_ListOfShape& between = faces_of_edges(i);
    const TopoDS_Edge& edge = TopoDS::Edge(faces_of_edges.FindKey(i));
    if (between.Extent() == 2 && !BRep_Tool::Degenerated(edge))
      all.add(edge, between.First(), between.Last());
  }
  return std::move(all).groups();
}

}  // namespace nurbeam
