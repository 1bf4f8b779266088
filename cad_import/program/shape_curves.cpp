#include "cad_import/program/shape_curves.h"

#include <BRep_Tool.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_TShape.hxx>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "cad_import/occt/centre_line.h"
#include "cad_import/occt/edge_curve.h"
#include "cad_import/program/reading_share.h"
#include "cad_import/report/length_unit.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

std::string edge_label(int number, const Origin& origin) {
  std::string label = "edge " + std::to_string(number);
  if (!origin.name.empty()) label += " '" + origin.name + "'";
  return origin.label.empty() ? label : label + " (" + origin.label + ")";
}

void note_approximation(const ImportedCurve& curve, const std::string& label, double tolerance,
                        ImportReport& report) {
  constexpr double round_off = 1e-12;  // of the length
  if (curve.exact || curve.deviation <= round_off * length(curve.curve)) return;
  const Severity severity = curve.deviation <= tolerance ? Severity::note : Severity::warning;
  add_diagnostic(report, severity, label,
                 "a curve of kind '" + curve.entity +
                     "' has no exact NURBS form; approximated by a cubic with a deviation of " +
                     text_of(curve.deviation / metres_per_millimetre) + " mm");
}

// What is unnamed itself goes by the name of its part, but for the many edges of a solid.
void name_by_part(const TopoDS_Shape& shape, const PartNames& parts, ImportedCurve& curve) {
  if (!parts.IsBound(shape)) return;
  const PartName& part = parts.Find(shape);
  curve.part = part.path;
  if (curve.name.empty() && (curve.free || curve.is_centre_line())) curve.name = part.own;
}

void add_edge(const TopoDS_Edge& edge, bool free, const std::string& label, const Origin& origin,
              const ShapeFacts& facts, double tolerance, ImportReport& report) {
  try {
    OCC_CATCH_SIGNALS
    ImportedCurve curve = imported_curve(edge, tolerance);
    if (!facts.places.put_in_place(edge.Location(), curve)) return;
    curve.name = origin.name;
    curve.layer = origin.appearance.layer;
    curve.colour = origin.appearance.colour;
    curve.hidden = origin.appearance.hidden;
    curve.free = free;
    name_by_part(edge, facts.parts, curve);
    note_approximation(curve, label, tolerance, report);
    report.curves.push_back(std::move(curve));
  } catch (const Standard_Failure& e) {
    add_diagnostic(report, Severity::warning, label,
                   std::string("skipped, no valid curve: ") + e.GetMessageString());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    add_diagnostic(report, Severity::warning, label, std::string("skipped, no valid curve: ") + e.what());
  }
}

}  // namespace

CurvesOfEdges add_edges(const TopoDS_Shape& shape, const ShapeFacts& facts, double tolerance,
                        ImportReport& report) {
  CurvesOfEdges curves;
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of_edges);
  for (int i = 1; i <= faces_of_edges.Extent(); ++i) {
    tell_share_of(reading_share::edges, static_cast<std::size_t>(i - 1),
                  static_cast<std::size_t>(faces_of_edges.Extent()));
    const TopoDS_Edge& edge = TopoDS::Edge(faces_of_edges.FindKey(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    const auto known = facts.origins.find(edge.TShape().get());
    const Origin origin = known == facts.origins.end() ? Origin{} : known->second;
    if (origin.left_out) continue;
    const bool free = faces_of_edges(i).IsEmpty();
    const std::size_t before = report.curves.size();
    add_edge(free ? facts.senses.of(edge) : edge, free, edge_label(i, origin), origin, facts, tolerance,
             report);
    if (report.curves.size() > before) curves[edge.TShape().get()].push_back(before);
  }
  return curves;
}

void add_centre_lines(const TopoDS_Shape& shape, const ShapeFacts& facts, double tolerance,
                      ImportReport& report) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  CentreLines found = centre_lines(shape, tolerance);
  for (CentreLine& line : found.lines) {
    if (!facts.places.put_in_place(faces(line.face).Location(), line.curve)) continue;
    const auto known = facts.origins.find(faces(line.face).TShape().get());
    if (known != facts.origins.end()) {
      if (known->second.left_out) continue;
      line.curve.name = known->second.name;
      line.curve.layer = known->second.appearance.layer;
      line.curve.colour = known->second.appearance.colour;
      line.curve.hidden = known->second.appearance.hidden;
    }
    name_by_part(faces(line.face), facts.parts, line.curve);
    report.curves.push_back(std::move(line.curve));
  }
  for (const std::string& remark : found.remarks) add_diagnostic(report, Severity::note, "", remark);
}

}  // namespace nurbeam
