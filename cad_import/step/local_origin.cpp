#include "cad_import/step/local_origin.h"

#include <BRepBuilderAPI_Transform.hxx>
#include <TopLoc_Location.hxx>
#include <gp_Trsf.hxx>
#include <gp_Vec.hxx>

#include "cad_import/report/length_unit.h"

namespace nurbeam {

Eigen::Vector3d local_origin(const NurbsCurve& curve) {
  constexpr double near = 1e4;  // [m]; its digits there are finer than a tenth of 1e-7 mm
  const Eigen::Matrix3Xd places = curve.control_points().colwise().hnormalized();
  const Eigen::Vector3d middle = (places.rowwise().minCoeff() + places.rowwise().maxCoeff()) / 2;
  if (middle.cwiseAbs().maxCoeff() <= near) return Eigen::Vector3d::Zero();
  return middle.array().round();
}

NurbsCurve moved_to_origin(const NurbsCurve& curve, const Eigen::Vector3d& point) {
  Eigen::Matrix4Xd points = curve.control_points();
  for (auto column : points.colwise()) column.head<3>() = column(3) * (column.head<3>() / column(3) - point);
  return {curve.knots(), points};
}

NamedSolid moved_to_origin(NamedSolid solid, const Eigen::Vector3d& point) {
  if (auto* pipe = std::get_if<NamedPipe>(&solid)) {
    pipe->axis.curve = moved_to_origin(pipe->axis.curve, point);
    return solid;
  }
  for (auto& loop : std::get<SweptProfile>(solid).loops)
    for (SweptCubic& cubic : loop)
      for (NurbsCurve& rail : cubic.rails) rail = moved_to_origin(rail, point);
  return solid;
}

TopoDS_Shape moved_back(const TopoDS_Shape& shape, const Eigen::Vector3d& point) {
  if (point.isZero()) return shape;
  gp_Trsf move;
  const Eigen::Vector3d millimetres = point * millimetres_per_metre;
  move.SetTranslation(gp_Vec(millimetres.x(), millimetres.y(), millimetres.z()));
  return shape.Moved(TopLoc_Location(move));
}

TopoDS_Shape moved_in_itself(const TopoDS_Shape& shape) {
  if (shape.Location().IsIdentity()) return shape;
  constexpr bool with_geometry = true;
  return BRepBuilderAPI_Transform(shape.Located(TopLoc_Location()), shape.Location().Transformation(),
                                  with_geometry)
      .Shape();
}

Eigen::Vector3d local_origin(const NamedSolid& solid) {
  if (const auto* pipe = std::get_if<NamedPipe>(&solid)) return local_origin(pipe->axis.curve);
  const auto& loops = std::get<SweptProfile>(solid).loops;
  if (loops.empty() || loops.front().empty()) return Eigen::Vector3d::Zero();
  return local_origin(loops.front().front().rails.front());
}

}  // namespace nurbeam
