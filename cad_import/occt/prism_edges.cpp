#include "cad_import/occt/prism_edges.h"

#include <Adaptor3d_Curve.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Geometry>
#include <GeomLib_IsPlanarSurface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <gp.hxx>
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

/// The plane of a face, also where that is written as a spline.
std::optional<gp_Pln> plane_of(const TopoDS_Face& face) {
  constexpr double flat = 1e-6;  // [mm]
  const BRepAdaptor_Surface surface(face, /*restriction=*/false);
  if (surface.GetType() == GeomAbs_Plane) return surface.Plane();
  if (surface.GetType() != GeomAbs_BSplineSurface) return std::nullopt;
  const GeomLib_IsPlanarSurface planar(BRep_Tool::Surface(face), flat);
  return planar.IsPlanar() ? std::optional(planar.Plan()) : std::nullopt;
}

/// Whether a curve is a line, also one that is written as a spline.
bool is_straight(const Adaptor3d_Curve& curve) {
  if (curve.GetType() == GeomAbs_Line) return true;
  return curve.GetType() == GeomAbs_BSplineCurve && curve.BSpline()->Degree() == 1 &&
         curve.BSpline()->NbPoles() == 2;
}

Eigen::Vector3d direction_of(const Adaptor3d_Curve& line) {
  return vector_of(line.Value(line.LastParameter()).XYZ() - line.Value(line.FirstParameter()).XYZ())
      .normalized();
}

bool are_parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.cross(b).norm() <= parallel_within;
}

/// The cylinder of a face, also where that is written as a line that turns about an axis.
std::optional<gp_Cylinder> cylinder_of(const BRepAdaptor_Surface& surface) {
  if (surface.GetType() == GeomAbs_Cylinder) return surface.Cylinder();
  if (surface.GetType() != GeomAbs_SurfaceOfRevolution) return std::nullopt;
  const Handle(Adaptor3d_Curve) line = surface.BasisCurve();
  const gp_Ax1 axis = surface.AxeOfRevolution();
  if (!is_straight(*line) || !are_parallel(direction_of(*line), vector_of(axis.Direction().XYZ())))
    return std::nullopt;
  const double radius = gp_Lin(axis).Distance(line->Value(line->FirstParameter()));
  if (!(radius > gp::Resolution())) return std::nullopt;
  return gp_Cylinder(gp_Ax3(axis.Location(), axis.Direction()), radius);
}

/// Nothing for one that is neither a plane nor a cylinder along these axes.
std::optional<PrismSide> side_of(const TopoDS_Face& face, const Eigen::Matrix3d& axes) {
  const BRepAdaptor_Surface surface(face, /*restriction=*/false);
  const auto across = [&](const gp_XYZ& xyz) -> Eigen::Vector2d {
    return (axes.transpose() * vector_of(xyz)).head<2>();
  };
  if (const std::optional<gp_Pln> plane = plane_of(face)) {
    const Eigen::Vector2d normal = across(plane->Axis().Direction().XYZ());
    return PrismSide{{-normal.y(), normal.x()}, {}, {}};
  }
  const std::optional<gp_Cylinder> cylinder = cylinder_of(surface);
  if (!cylinder || !are_parallel(vector_of(cylinder->Axis().Direction().XYZ()), axes.col(2)))
    return std::nullopt;
  const Bounds b = bounds_of(face);
  return PrismSide{{},
                   across(cylinder->Location().XYZ()),
                   across(surface.Value((b.u0 + b.u1) / 2, (b.v0 + b.v1) / 2).XYZ()),
                   cylinder->Radius()};
}

class EdgesByDirection {
 public:
  explicit EdgesByDirection(const TopTools_IndexedMapOfShape& faces) : faces_(faces) {}

  void add(const TopoDS_Edge& edge, const TopoDS_Shape& one, const TopoDS_Shape& other) {
    const BRepAdaptor_Curve curve(edge);
    if (!is_straight(curve)) return;
    const Eigen::Vector3d start = vector_of(curve.Value(curve.FirstParameter()).XYZ()),
                          end = vector_of(curve.Value(curve.LastParameter()).XYZ());
    PrismEdges* const group = group_of(direction_of(curve));
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
      if (are_parallel(group.axes.col(2), direction)) return &group;
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

bool is_side_of_prism(const TopoDS_Face& face) {
  return plane_of(face) || cylinder_of(BRepAdaptor_Surface(face, /*restriction=*/false));
}

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
