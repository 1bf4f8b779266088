#include "cad_import/step/trimmed_conic.h"

#include <ElCLib.hxx>
#include <Geom_CartesianPoint.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Interface_EntityIterator.hxx>
#include <Standard_Failure.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_CurveReplica.hxx>
#include <StepGeom_HArray1OfTrimmingSelect.hxx>
#include <StepGeom_Hyperbola.hxx>
#include <StepGeom_Parabola.hxx>
#include <StepGeom_SurfaceCurve.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepGeom_TrimmingSelect.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_VertexPoint.hxx>
#include <StepToGeom.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_Parab.hxx>
#include <gp_Pnt.hxx>
#include <stdexcept>
#include <utility>

#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

/// One end of the piece.
struct Trim {
  std::optional<gp_Pnt> point;  // [mm]
  std::optional<double> parameter;
};
using Trims = std::array<Trim, 2>;

std::optional<gp_Pnt> place_of(const Handle(StepGeom_CartesianPoint) & point) {
  const Handle(Geom_CartesianPoint) place =
      point.IsNull() ? Handle(Geom_CartesianPoint)() : StepToGeom::MakeCartesianPoint(point);
  return place.IsNull() ? std::nullopt : std::optional(place->Pnt());
}

Trim trim_of(const Handle(StepGeom_HArray1OfTrimmingSelect) & values) {
  Trim trim;
  for (int i = 1; !values.IsNull() && i <= values->Length(); ++i) {
    const StepGeom_TrimmingSelect& value = values->Value(i);
    if (value.CaseMember() > 0) trim.parameter = value.ParameterValue();
    if (value.CaseNumber() > 0) trim.point = place_of(value.CartesianPoint());
  }
  return trim;
}

Handle(StepGeom_HArray1OfTrimmingSelect) values_of(double parameter) {
  const Handle(StepGeom_HArray1OfTrimmingSelect) values = new StepGeom_HArray1OfTrimmingSelect(1, 1);
  StepGeom_TrimmingSelect value;
  value.SetParameterValue(parameter);
  values->SetValue(1, value);
  return values;
}

/// The curve that a piece is one of, whatever repeats it in between.
Handle(StepGeom_Curve) origin_of(Handle(StepGeom_Curve) curve) {
  constexpr int deepest = 100;
  for (int depth = 0; depth < deepest; ++depth)
    if (const auto replica = Handle(StepGeom_CurveReplica)::DownCast(curve))
      curve = replica->ParentCurve();
    else if (const auto on_surface = Handle(StepGeom_SurfaceCurve)::DownCast(curve))
      curve = on_surface->Curve3d();
    else
      return curve;
  throw std::runtime_error("it is a piece of itself, or nested too deeply");
}

/// Where the vertices of the edge that has this geometry say that it begins and ends.
void add_vertices(const StepGeom_TrimmedCurve& trimmed, const Interface_Graph& graph, Trims& trims) {
  for (Interface_EntityIterator user = graph.Sharings(&trimmed); user.More(); user.Next()) {
    const auto edge = Handle(StepShape_EdgeCurve)::DownCast(user.Value());
    if (edge.IsNull()) continue;
    const auto start = Handle(StepShape_VertexPoint)::DownCast(edge->EdgeStart());
    const auto end = Handle(StepShape_VertexPoint)::DownCast(edge->EdgeEnd());
    if (start.IsNull() || end.IsNull()) continue;
    trims[0].point = place_of(Handle(StepGeom_CartesianPoint)::DownCast(start->VertexGeometry()));
    trims[1].point = place_of(Handle(StepGeom_CartesianPoint)::DownCast(end->VertexGeometry()));
    if (!edge->SameSense()) std::swap(trims[0].point, trims[1].point);
    return;
  }
}

using Lengths = std::array<double, 2>;

std::string lengths_text(const Lengths& lengths) {
  return "y = " + text_of(lengths[0]) + " mm to " + text_of(lengths[1]) + " mm from its axis";
}

/// The ends as distances from the axis [mm]: both meanings of the parameters, and what the points say.
struct Readings {
  Lengths by_standard, as_lengths, of_points;
};

bool agree(const Lengths& a, const Lengths& b, double size) {
  constexpr double digits = 1e-5;
  return std::abs(a[0] - b[0]) <= digits * size && std::abs(a[1] - b[1]) <= digits * size;
}

struct Decision {
  Lengths lengths;
  std::optional<std::string> warning = {};
};

Decision by_points(const Readings& readings, const std::string& given, double size) {
  for (const Lengths& reading : {readings.by_standard, readings.as_lengths})
    if (agree(reading, readings.of_points, size)) return {reading};
  return {readings.of_points,
          given + " contradict its cartesian points, which were taken: " + lengths_text(readings.of_points) +
              "; by ISO 10303-42 the parameters are " + lengths_text(readings.by_standard)};
}

Decision by_system(const Readings& readings, const std::string& given, bool by_open_cascade, double size) {
  if (by_open_cascade) return {readings.as_lengths};
  if (agree(readings.by_standard, readings.as_lengths, size)) return {readings.by_standard};
  return {readings.by_standard,
          given + " were read as ISO 10303-42 has them, " + lengths_text(readings.by_standard) +
              "; a system that writes lengths for them, as OpenCASCADE does, means " +
              lengths_text(readings.as_lengths) + ": export it with cartesian trim points"};
}

std::optional<std::string> restate_parabola(StepGeom_TrimmedCurve& trimmed,
                                            const Handle(StepGeom_Parabola) & basis,
                                            const Interface_Graph& graph, bool by_open_cascade) {
  Trims trims{trim_of(trimmed.Trim1()), trim_of(trimmed.Trim2())};
  if (!trims[0].parameter && !trims[1].parameter) return std::nullopt;  // by points only: as they are
  if (!trims[0].point || !trims[1].point) add_vertices(trimmed, graph, trims);
  const Handle(Geom_Parabola) parabola = StepToGeom::MakeParabola(basis);
  if (parabola.IsNull()) throw std::runtime_error("OpenCASCADE makes no parabola of it");
  Readings readings{};
  double size = parabola->Focal();
  for (int i = 0; i < 2; ++i) {
    const Trim& trim = trims[i];
    if (trim.point) readings.of_points[i] = ElCLib::Parameter(parabola->Parab(), *trim.point);
    readings.by_standard[i] =
        trim.parameter ? 2 * parabola->Focal() * *trim.parameter : readings.of_points[i];
    readings.as_lengths[i] = trim.parameter.value_or(readings.of_points[i]);
    if (!trim.point) readings.of_points[i] = readings.by_standard[i];
    size = std::max({size, std::abs(readings.by_standard[i]), std::abs(readings.of_points[i])});
  }
  const bool has_points = trims[0].point && trims[1].point;
  const auto text = [](const Trim& trim) {
    return trim.parameter ? text_of(*trim.parameter) : std::string("a point");
  };
  const std::string given = "its trim parameters " + text(trims[0]) + " to " + text(trims[1]);
  Decision decision =
      has_points ? by_points(readings, given, size) : by_system(readings, given, by_open_cascade, size);
  trimmed.SetTrim1(values_of(decision.lengths[0]));
  trimmed.SetTrim2(values_of(decision.lengths[1]));
  trimmed.SetMasterRepresentation(StepGeom_tpParameter);
  return decision.warning;
}

/// Whether OpenCASCADE goes by the points of the piece.
bool is_trimmed_by_points(const StepGeom_TrimmedCurve& trimmed) {
  const Trims trims{trim_of(trimmed.Trim1()), trim_of(trimmed.Trim2())};
  const bool has_parameters = trims[0].parameter || trims[1].parameter;
  return trims[0].point && trims[1].point &&
         (!has_parameters || trimmed.MasterRepresentation() == StepGeom_tpCartesian);
}

/// Along chords [mm].
double rough_length(const Geom_Curve& curve) {
  constexpr int chords = 8;
  const double first = curve.FirstParameter(), step = (curve.LastParameter() - first) / chords;
  double sum = 0;
  for (int i = 0; i < chords; ++i)
    sum += curve.Value(first + i * step).Distance(curve.Value(first + (i + 1) * step));
  return sum;
}

}  // namespace

std::optional<std::string> misplaced_trims(const Handle(StepGeom_TrimmedCurve) & trimmed) {
  constexpr double digits = 1e-3;  // of the piece
  try {
    const Handle(Geom_TrimmedCurve) piece = StepToGeom::MakeTrimmedCurve(trimmed);
    if (piece.IsNull()) return std::nullopt;
    const std::optional<gp_Pnt> first = trim_of(trimmed->Trim1()).point,
                                last = trim_of(trimmed->Trim2()).point;
    const double at_first = first ? first->Distance(piece->StartPoint()) : 0;
    const double at_last = last ? last->Distance(piece->EndPoint()) : 0;
    if (!(std::max(at_first, at_last) > digits * rough_length(*piece))) return std::nullopt;
    return "it begins " + text_of(at_first) + " mm and ends " + text_of(at_last) +
           " mm from the points that trim it, which contradict its curve, its parameters or its sense: correct "
           "them";
  } catch (const Standard_Failure&) {
    return std::nullopt;  // said where it is translated
  }
}

std::optional<std::string> restate_trims(StepGeom_TrimmedCurve& trimmed, const Interface_Graph& graph,
                                         bool by_open_cascade) {
  const Handle(StepGeom_Curve) basis = origin_of(trimmed.BasisCurve());
  if (basis.IsNull()) return std::nullopt;
  if (const auto parabola = Handle(StepGeom_Parabola)::DownCast(basis))
    return restate_parabola(trimmed, parabola, graph, by_open_cascade);
  if (basis != trimmed.BasisCurve() && !basis->IsKind(STANDARD_TYPE(StepGeom_Hyperbola)) &&
      !is_trimmed_by_points(trimmed))
    throw std::runtime_error(
        "it trims a replica of a curve by parameters, which is not read; trim the curve "
        "itself, or by cartesian points");
  return std::nullopt;
}

}  // namespace nurbeam
