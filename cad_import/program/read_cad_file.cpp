#include "cad_import/program/read_cad_file.h"

#include <BRep_Tool.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <OSD.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepRepr_GlobalUncertaintyAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_GeometricSet.hxx>
#include <TColStd_HSequenceOfTransient.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_TShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <set>
#include <stdexcept>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "cad_import/dxf/read_dxf.h"
#include "cad_import/files/tolerant_text.h"
#include "cad_import/iges/iges_global.h"
#include "cad_import/occt/appearance.h"
#include "cad_import/occt/centre_line.h"
#include "cad_import/occt/edge_curve.h"
#include "cad_import/occt/occt_session.h"
#include "cad_import/program/brep_text.h"
#include "cad_import/program/damaged_entities.h"
#include "cad_import/program/entity_origins.h"
#include "cad_import/program/external_parts.h"
#include "cad_import/program/lost_curves.h"
#include "cad_import/program/memory_file.h"
#include "cad_import/program/part_names.h"
#include "cad_import/report/length_unit.h"
#include "cad_import/step/step_units.h"
#include "cad_import/step/supplemental_geometry.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

constexpr int most_reported_failures = 20;

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
              const PartNames& parts, double tolerance, ImportReport& report) {
  try {
    OCC_CATCH_SIGNALS
    ImportedCurve curve = imported_curve(edge, tolerance);
    curve.name = origin.name;
    curve.layer = origin.appearance.layer;
    curve.colour = origin.appearance.colour;
    curve.hidden = origin.appearance.hidden;
    curve.free = free;
    name_by_part(edge, parts, curve);
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

// Centre lines stand after the curves of the file, whose numbers they leave as they are.
void add_centre_lines(const TopoDS_Shape& shape, const Origins& origins, const PartNames& parts,
                      double tolerance, ImportReport& report) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  CentreLines found = centre_lines(shape, tolerance);
  for (CentreLine& line : found.lines) {
    const auto known = origins.find(faces(line.face).TShape().get());
    if (known != origins.end()) {
      if (known->second.left_out) continue;
      line.curve.name = known->second.name;
      line.curve.layer = known->second.appearance.layer;
      line.curve.colour = known->second.appearance.colour;
      line.curve.hidden = known->second.appearance.hidden;
    }
    name_by_part(faces(line.face), parts, line.curve);
    report.curves.push_back(std::move(line.curve));
  }
  for (const std::string& remark : found.remarks) add_diagnostic(report, Severity::note, "", remark);
}

void note_hidden(ImportReport& report) {
  const auto hidden = std::count_if(report.curves.begin(), report.curves.end(),
                                    [](const ImportedCurve& curve) { return curve.hidden; });
  if (hidden > 0)
    add_diagnostic(
        report, Severity::note, "",
        std::to_string(hidden) + " curve(s) are hidden in the file and are taken only by name or number");
}

void add_edges_of(const TopoDS_Shape& shape, const Origins& origins, const PartNames& parts, double tolerance,
                  ImportReport& report) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of_edges);
  for (int i = 1; i <= faces_of_edges.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(faces_of_edges.FindKey(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    const auto known = origins.find(edge.TShape().get());
    const Origin origin = known == origins.end() ? Origin{} : known->second;
    if (origin.left_out) continue;
    add_edge(edge, faces_of_edges(i).IsEmpty(), edge_label(i, origin), origin, parts, tolerance, report);
  }
}

LostCurves add_edges(const XSControl_Reader& reader, double tolerance, ImportReport& report) {
  const TopoDS_Shape shape = reader.OneShape();
  if (shape.IsNull()) return add_lost_curves(reader, tolerance, report);
  const Origins origins = origins_of_edges_and_faces(reader, report);
  const PartNames parts = part_names(reader, shape);
  add_edges_of(shape, origins, parts, tolerance, report);
  LostCurves lost = add_lost_curves(reader, tolerance, report);
  add_centre_lines(shape, origins, parts, tolerance, report);
  return lost;
}

// What OpenCASCADE failed to read or to translate, and nobody else made a curve of or named.
void add_failures(const Interface_CheckIterator& checks, const Interface_InterfaceModel& model,
                  const LostCurves& lost, ImportReport& report) {
  Interface_CheckIterator failures = checks.Extract(Interface_CheckFail);
  int count = 0;
  for (failures.Start(); failures.More(); failures.Next()) {
    const auto entity = model.NbEntities() >= failures.Number() && failures.Number() > 0
                            ? model.Value(failures.Number())
                            : Handle(Standard_Transient)();
    if (lost.contain(entity.get()) || ++count > most_reported_failures) continue;
    add_diagnostic(report, Severity::warning, entity.IsNull() ? "" : entity_label(model, entity),
                   std::string("OpenCASCADE: ") + failures.Value()->CFail(1));
  }
  if (count > most_reported_failures) {
    add_diagnostic(report, Severity::warning, "",
                   std::to_string(count - most_reported_failures) + " more such failures");
  }
}

void transfer(XSControl_Reader& reader, double tolerance, ImportReport& report) {
  reader.TransferRoots();
  const LostCurves lost = add_edges(reader, tolerance, report);
  const Handle(XSControl_WorkSession) session = reader.WS();
  add_failures(session->TransferReader()->TransientProcess()->CheckList(Standard_True), *reader.Model(), lost,
               report);
}

// OpenCASCADE goes on after an error of syntax, with other numbers than those of the file.
void check_syntax(const Interface_InterfaceModel& model) {
  const Handle(Interface_Check) check = model.GlobalCheck(/*syntactic=*/Standard_True);
  for (int i = 1; i <= check->NbFails(); ++i) {
    const std::string_view failure = check->CFail(i);
    const std::size_t at = failure.find("Line ");
    if (failure.find("Incorrect syntax") == std::string_view::npos) continue;
    throw std::runtime_error(std::string(failure.substr(at == std::string_view::npos ? 0 : at)) +
                             "; the file is damaged; export or copy it again");
  }
}

// OpenCASCADE computes for minutes with numbers that no drawing holds.
void check_coordinates(const Interface_InterfaceModel& model) {
  constexpr double largest = 1e15;  // in units of the file
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto point = Handle(StepGeom_CartesianPoint)::DownCast(model.Value(i));
    for (int k = 1; !point.IsNull() && k <= point->NbCoordinates(); ++k)
      if (!(std::abs(point->CoordinatesValue(k)) <= largest))
        throw std::runtime_error(entity_label(model, point) + " has a coordinate of " +
                                 text_of(point->CoordinatesValue(k)) + "; the limit is " + text_of(largest) +
                                 ": the file is damaged; export or copy it again");
  }
}

void read(XSControl_Reader& reader, const std::string& content, ImportReport& report) {
  const MemoryFile file(content);
  if (reader.ReadFile(file.path().c_str()) != IFSelect_RetDone || reader.Model().IsNull())
    throw std::runtime_error("OpenCASCADE cannot read it: the syntax is damaged; export or copy it again");
  check_syntax(*reader.Model());
  check_coordinates(*reader.Model());
  add_damaged_entities(*reader.Model(), content, report);
}

// -------------------------------------------------------------------------------------------------------
// units

void report_unit(double in_metres, ImportReport& report) {
  const NamedUnit unit = named_unit(in_metres);
  report.unit = unit.name;
  report.unit_in_metres = unit.in_metres;
}

// -------------------------------------------------------------------------------------------------------
// STEP

Handle(StepRepr_GlobalUncertaintyAssignedContext) uncertainty_of(const Handle(Standard_Transient) & entity) {
  const auto context =
      Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(entity);
  return context.IsNull() ? Handle(StepRepr_GlobalUncertaintyAssignedContext)()
                          : context->GlobalUncertaintyAssignedContext();
}

/// What the representation contexts of a file declare.
struct StepContexts {
  std::set<double> length_units;  // [m]
  double resolution = 0;          // the coarsest [m]
};

StepContexts contexts_of(const Interface_InterfaceModel& model) {
  StepContexts contexts;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const std::optional<double> unit = length_unit_of(model.Value(i));
    if (!unit) continue;
    contexts.length_units.insert(*unit);
    const Handle(StepRepr_GlobalUncertaintyAssignedContext) uncertainty = uncertainty_of(model.Value(i));
    if (uncertainty.IsNull()) continue;
    STEPConstruct_UnitContext factors;
    factors.ComputeFactors(units_of(model.Value(i)));
    factors.ComputeTolerance(uncertainty);
    if (!factors.HasUncertainty()) continue;
    // OpenCASCADE leaves the number in the context's own length unit.
    const double resolution = factors.Uncertainty() * *unit;
    if (std::isfinite(resolution)) contexts.resolution = std::max(contexts.resolution, resolution);
  }
  return contexts;
}

void report_step_unit(const Interface_InterfaceModel& model, ImportReport& report) {
  const StepContexts contexts = contexts_of(model);
  const std::set<double>& units = contexts.length_units;
  report.resolution = contexts.resolution;
  if (units.empty()) {
    add_diagnostic(report, Severity::warning, "",
                   "the file declares no length unit; millimetres are assumed");
  }
  if (units.size() > 1) {
    add_diagnostic(report, Severity::note, "",
                   "the file has parts in different length units; each is scaled by its own");
  }
  report_unit(units.empty() ? metres_per_millimetre : *units.begin(), report);
}

void read_step(const std::string& content, double tolerance, const ReadFile& read_other,
               ImportReport& report) {
  start_step();
  STEPControl_Reader reader;
  read(reader, content, report);
  report_step_unit(*reader.Model(), report);
  join_supplemental_geometry(reader);
  transfer(reader, tolerance, report);
  add_external_parts(reader, read_other, report);
  note_hidden(report);
}

// -------------------------------------------------------------------------------------------------------
// IGES

void compare_units(const IgesGlobal& ours, const IGESData_GlobalSection& theirs) {
  const double in_metres = theirs.UnitValue() * metres_per_millimetre;
  if (is_same_unit(in_metres, ours.unit_in_metres)) return;
  throw std::runtime_error("the Global section says that the length unit is " + text_of(ours.unit_in_metres) +
                           " m, but OpenCASCADE takes it for " + text_of(in_metres) +
                           " m; correct the Global section (Hollerith counts, parameters 14 and 15)");
}

void read_iges(const std::string& content, double tolerance, ImportReport& report) {
  const IgesGlobal global = parse_iges_global(content);
  report_unit(global.unit_in_metres, report);
  if (global.scale != 1) {
    add_diagnostic(report, Severity::note, "",
                   "the model space scale " + text_of(global.scale) + " (drawing scale) is not applied");
  }
  if (const auto miscounted = miscounted_lines(content))
    add_diagnostic(report, Severity::warning, "", *miscounted);
  start_iges();
  // Only after Init: before it, the parameter is unknown and curves are split where they are only C0.
  if (!Interface_Static::SetIVal("read.iges.bspline.continuity", 0))
    throw std::runtime_error("OpenCASCADE refuses read.iges.bspline.continuity = 0");
  IGESControl_Reader reader;
  read(reader, content, report);
  compare_units(global, reader.IGESModel()->GlobalSection());
  const double resolution = reader.IGESModel()->GlobalSection().Resolution();
  if (std::isfinite(resolution) && resolution > 0) report.resolution = resolution * global.unit_in_metres;
  transfer(reader, tolerance, report);
  note_hidden(report);
}

// -------------------------------------------------------------------------------------------------------
// DXF and BREP

void read_drawing(const std::string& content, ImportReport& report) {
  ImportReport drawing = read_dxf(content);
  for (Diagnostic& diagnostic : drawing.diagnostics)
    add_diagnostic(report, diagnostic.severity, diagnostic.where, diagnostic.message);
  drawing.file = report.file;
  drawing.diagnostics = std::move(report.diagnostics);
  report = std::move(drawing);
  note_hidden(report);
}

void read_brep(const std::string& content, double tolerance, ImportReport& report) {
  const TopoDS_Shape shape = brep_shape(content);
  report_unit(metres_per_millimetre, report);
  add_diagnostic(report, Severity::note, "", "BREP files declare no length unit; millimetres are assumed");
  add_edges_of(shape, {}, {}, tolerance, report);
  add_centre_lines(shape, {}, {}, tolerance, report);
}

void read_format(const std::string& content, CadFormat format, double tolerance, const ReadFile& read_other,
                 ImportReport& report) {
  switch (format) {
    case CadFormat::step:
      return read_step(content, tolerance, read_other, report);
    case CadFormat::iges:
      return read_iges(content, tolerance, report);
    case CadFormat::dxf:
      return read_drawing(content, report);
    case CadFormat::brep:
      return read_brep(content, tolerance, report);
  }
}

}  // namespace

ImportReport read_cad_file(const std::filesystem::path& file, const std::string& content, CadFormat format,
                           double tolerance, const ReadFile& read_other) {
  ImportReport report;
  report.file = file.string();
  be_silent();
  try {
    OCC_CATCH_SIGNALS
    read_format(content, format, tolerance, read_other, report);
  } catch (const Standard_Failure& e) {
    add_diagnostic(report, Severity::error, "",
                   std::string("OpenCASCADE failed (") + e.DynamicType()->Name() + " " +
                       e.GetMessageString() +
                       "); the file is damaged or uses what OpenCASCADE cannot read; export it again");
  } catch (const std::runtime_error& e) {
    add_diagnostic(report, Severity::error, "", e.what());
  }
  if (report.ok() && report.curves.empty()) {
    add_diagnostic(report, Severity::error, "",
                   "no curve in the file; expected at least one edge or free curve (line, conic, B-spline)");
  }
  return report;
}

}  // namespace nurbeam
