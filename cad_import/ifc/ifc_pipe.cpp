#include "cad_import/ifc/ifc_pipe.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "cad_import/ifc/conic_curve.h"
#include "cad_import/ifc/cut_directrix.h"
#include "cad_import/ifc/fillets.h"
#include "cad_import/ifc/ifc_curve.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

constexpr double same_direction = 1e-9;

ImportedCurve centre_of(NurbsCurve curve) { return {.entity = "", .curve = std::move(curve)}; }

NurbsCurve straight(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Eigen::Matrix3Xd ends(3, 2);
  ends << from, to;
  return make_nurbs_curve(KnotVector(1, {0, 0, 1, 1}), ends, Eigen::VectorXd::Ones(2));
}

std::optional<double> number_or_none(const IfcValue& value) {
  return value.kind == IfcValue::Kind::none ? std::nullopt : std::optional(value.as_number());
}

void round_corners(IfcPipe& pipe, double radius) {
  if (!(radius > 0) || pipe.centre.size() != 1 || pipe.centre[0].curve.degree() != 1) return;
  std::vector<ImportedCurve> rounded;
  for (NurbsCurve& curve : with_fillets(pipe.centre[0].curve, radius))
    rounded.push_back(centre_of(std::move(curve)));
  pipe.centre = std::move(rounded);
}

IfcPipe swept_disk(const IfcModel& model, const IfcValue& solid, double tolerance) {
  if (!solid.at(0).is_reference()) throw std::runtime_error("it has no directrix");
  IfcPipe pipe{{}, solid.at(1).as_number(), number_or_none(solid.at(2)).value_or(0)};
  CutDirectrix cut = cut_directrix(ifc_curves(model, solid.at(0).reference, tolerance),
                                   number_or_none(solid.at(3)), number_or_none(solid.at(4)));
  pipe.remark = std::move(cut.remark);
  pipe.centre = std::move(cut.curves);
  if (solid.text == "IFCSWEPTDISKSOLIDPOLYGONAL" && solid.at(5).kind != IfcValue::Kind::none)
    round_corners(pipe, solid.at(5).as_number());
  return pipe;
}

/// Without a centre line.
IfcPipe pipe_of_profile(const IfcValue& circle) {
  IfcPipe pipe{{}, circle.at(3).as_number()};
  if (circle.text == "IFCCIRCLEHOLLOWPROFILEDEF") pipe.bore = pipe.radius - circle.at(4).as_number();
  return pipe;
}

/// Where the middle of the profile is, in the coordinates of the solid.
Eigen::Vector3d middle_of(const IfcModel& model, const IfcValue& circle) {
  return ifc_placement(model, circle.at(2)).translation();
}

std::optional<IfcPipe> extruded(const IfcModel& model, const IfcValue& solid, const IfcValue& circle) {
  const Eigen::Vector3d along = ifc_vector(model.at(solid.at(2)).at(0)).normalized();
  if (!(std::abs(along.z()) > 1 - same_direction)) return std::nullopt;
  const Eigen::Affine3d place = ifc_placement(model, solid.at(1));
  const Eigen::Vector3d start = middle_of(model, circle),
                        end = start + Eigen::Vector3d(0, 0, along.z() * solid.at(3).as_number());
  IfcPipe pipe = pipe_of_profile(circle);
  pipe.centre.push_back(centre_of(straight(place * start, place * end)));
  return pipe;
}

/// A bend, about an axis that lies in the plane of the profile.
IfcPipe revolved(const IfcModel& model, const IfcValue& solid, const IfcValue& circle) {
  const IfcValue axis = model.at(solid.at(2));
  const Eigen::Vector3d on_axis = ifc_point(model, axis.at(0));
  const Eigen::Vector3d along = axis.at(1).is_reference()
                                    ? ifc_vector(model.at(axis.at(1)).at(0)).normalized()
                                    : Eigen::Vector3d(0, 0, 1);
  IfcPipe pipe = pipe_of_profile(circle);
  const Eigen::Vector3d from_axis = middle_of(model, circle) - on_axis;
  const Eigen::Vector3d out = from_axis - from_axis.dot(along) * along;
  if (!(std::abs(along.z()) < same_direction && std::abs(on_axis.z()) <= same_direction * out.norm()))
    throw std::runtime_error("its axis does not lie in the plane of its profile");
  if (!(out.norm() > pipe.radius * (1 - same_direction)))
    throw std::runtime_error("its axis goes through its profile");
  const double angle = solid.at(3).as_number() * model.angle_unit();
  if (!(angle > 0 && angle <= 2 * std::numbers::pi * (1 + same_direction)))
    throw std::runtime_error("its angle is " + text_of(angle) + " rad; it must be up to a whole turn");
  Eigen::Affine3d turning = Eigen::Affine3d::Identity();
  turning.linear() << out.normalized(), along.cross(out.normalized()), along;
  turning.translation() = middle_of(model, circle) - out;
  pipe.centre.push_back(centre_of(conic_curve(Eigen::Vector2d::Constant(out.norm()), 0, angle,
                                              ifc_placement(model, solid.at(1)) * turning)));
  return pipe;
}

}  // namespace

std::optional<IfcPipe> ifc_pipe(const IfcModel& model, int item, double tolerance) {
  const std::string_view keyword = model.keyword(item);
  if (keyword.starts_with("IFCSWEPTDISKSOLID")) return swept_disk(model, model.instance(item), tolerance);
  const bool is_extruded = keyword == "IFCEXTRUDEDAREASOLID";
  if (!is_extruded && keyword != "IFCREVOLVEDAREASOLID") return std::nullopt;
  const IfcValue solid = model.instance(item), profile = model.at(solid.at(0));
  if (!profile.text.starts_with("IFCCIRCLE")) return std::nullopt;
  if (is_extruded) return extruded(model, solid, profile);
  return revolved(model, solid, profile);
}

}  // namespace nurbeam
