#include "cad_import/iges/offset_curve.h"

#include <Eigen/Geometry>
#include <IGESGeom_BSplineCurve.hxx>
#include <IGESGeom_CircularArc.hxx>
#include <IGESGeom_ConicArc.hxx>
#include <IGESGeom_Line.hxx>
#include <IGESGeom_OffsetCurve.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>
#include <gp_XYZ.hxx>
#include <numbers>
#include <stdexcept>
#include <string>

#include "cad_import/iges/conic_position.h"
#include "cad_import/iges/location.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using Entity = Handle(IGESData_IGESEntity);

struct Range {
  double first, last;
};

std::string range_text(const Range& range) { return text_of(range.first) + " to " + text_of(range.last); }

double angle_of(const Eigen::Vector2d& point, double x_radius, double y_radius) {
  return std::atan2(point.y() / y_radius, point.x() / x_radius);
}

/// Anticlockwise from the first, which is brought to [0, 2 pi).
Range anticlockwise(double first, double last) {
  constexpr double turn = 2 * std::numbers::pi;
  if (first < 0) first += turn;
  while (last <= first) last += turn;
  return {first, last};
}

/// The parameters that IGES gives to the whole arc of a conic, whose axes must be those of the entity.
Range whole_of(const IGESGeom_ConicArc& arc, ConicPosition::Kind kind) {
  double a = 0, b = 0, c = 0, d = 0, e = 0, f = 0;
  arc.Equation(a, b, c, d, e, f);
  const gp_Pnt2d start = arc.StartPoint(), end = arc.EndPoint();
  if (kind == ConicPosition::parabola) return a != 0 ? Range{start.X(), end.X()} : Range{start.Y(), end.Y()};
  const double x_radius = std::sqrt(-f / a), y_radius = std::sqrt(-f / c);
  return anticlockwise(angle_of({start.X(), start.Y()}, x_radius, y_radius),
                       angle_of({end.X(), end.Y()}, x_radius, y_radius));
}

/// The whole arc in OpenCASCADE's parameter, which goes by its own axes.
Range of_whole_conic(const IGESGeom_ConicArc& arc, const Range& given, double unit,
                     const Leniency& leniency) {
  const ConicPosition position = position_of(arc, leniency);
  if (position.kind == ConicPosition::hyperbola)
    throw std::runtime_error("it is the offset of a hyperbola, which is not read; write it as a B-spline");
  const Range whole = whole_of(arc, position.kind);
  constexpr double digits = 1e-6;
  const double size = std::abs(whole.first) + std::abs(whole.last);
  if (!(std::abs(given.first - whole.first) + std::abs(given.last - whole.last) <= digits * size))
    throw std::runtime_error("its parameters are " + range_text(given) +
                             "; only offsets of a whole conic, here " + range_text(whole) +
                             ", are read: cut the conic itself");
  if (position.kind == ConicPosition::parabola) return {position.start.y() * unit, position.end.y() * unit};
  const Eigen::Vector2d radii = position.radii;
  return anticlockwise(angle_of(position.start, radii.x(), radii.y()),
                       angle_of(position.end, radii.x(), radii.y()));
}

Range occt_range(const Entity& base, const Range& given, double unit, const Leniency& leniency) {
  if (!(given.first < given.last))
    throw std::runtime_error("its parameters are " + range_text(given) +
                             "; the first must be the smaller one");
  if (const auto line = Handle(IGESGeom_Line)::DownCast(base)) {
    const double length = line->StartPoint().Distance(line->EndPoint()) * unit;
    return {given.first * length, given.last * length};
  }
  if (const auto conic = Handle(IGESGeom_ConicArc)::DownCast(base))
    return of_whole_conic(*conic, given, unit, leniency);
  if (base->IsKind(STANDARD_TYPE(IGESGeom_CircularArc)) || base->IsKind(STANDARD_TYPE(IGESGeom_BSplineCurve)))
    return given;
  throw std::runtime_error(
      "it is the offset of an entity " + std::to_string(base->TypeNumber()) +
      "; only those of lines, circular arcs, conics and B-splines are read: write it as a "
      "B-spline");
}

/// What it is an offset of in the end; OpenCASCADE adds the distances up.
Entity base_of(const IGESGeom_OffsetCurve& offset) {
  constexpr int deepest = 100;
  constexpr double same_direction = 1e-9;
  Entity base = offset.BaseCurve();
  for (int depth = 0; depth < deepest; ++depth) {
    const auto inner = Handle(IGESGeom_OffsetCurve)::DownCast(base);
    if (inner.IsNull()) return base;
    if (inner->HasTransf() || inner->NormalVector().Angle(offset.NormalVector()) > same_direction)
      throw std::runtime_error(
          "it is the offset of an offset that is moved or turned; write it as a B-spline");
    base = inner->BaseCurve();
  }
  throw std::runtime_error("it is an offset of itself, or nested too deeply");
}

/// What OpenCASCADE turns into the normal, although it turns the offset curve as a whole besides.
gp_XYZ turned_back(const IGESGeom_OffsetCurve& offset) {
  const gp_Vec normal = offset.NormalVector();
  const Eigen::Vector3d back =
      rigid_location(offset).linear().transpose() * Eigen::Vector3d(normal.X(), normal.Y(), normal.Z());
  return {back.x(), back.y(), back.z()};
}

}  // namespace

void restate_offset(IGESGeom_OffsetCurve& offset, double unit, const Leniency& leniency) {
  const Entity base = base_of(offset);
  if (base.IsNull() || offset.OffsetType() != 1) return;  // OpenCASCADE refuses it itself
  const Range range = occt_range(base, {offset.StartParameter(), offset.EndParameter()}, unit, leniency);
  offset.Init(offset.BaseCurve(), 1, offset.Function(), offset.FunctionParameter(),
              offset.TaperedOffsetType(), offset.FirstOffsetDistance() * unit, offset.ArcLength1(),
              offset.SecondOffsetDistance(), offset.ArcLength2(), turned_back(offset), range.first,
              range.last);
}

}  // namespace nurbeam
