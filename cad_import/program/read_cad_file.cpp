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

#include "cad_import/iges/iges_global.h"
#include "cad_import/occt/appearance.h"
#include "cad_import/occt/centre_line.h"
#include "cad_import/occt/edge_curve.h"
#include "cad_import/occt/spline_defect.h"

namespace nurbeam {
namespace {

constexpr double metres_per_millimetre = 1e-3;
constexpr int most_reported_failures = 20;

/// The entity of the file that an edge came from.
struct Origin {
  std::string name;
  std::string label;
  Appearance appearance;
  bool defective = false;
};
// By the shared geometry of the edge; only ever looked up, so that no order depends on addresses.
using Origins = std::unordered_map<const TopoDS_TShape*, Origin>;

std::string text(const Handle(TCollection_HAsciiString) & value) {
  if (value.IsNull()) return "";
  std::string result = value->ToCString();
  result.erase(0, result.find_first_not_of(' '));
  return result.erase(result.find_last_not_of(' ') + 1);
}

void add(ImportReport& report, Severity severity, const std::string& entity, const std::string& message) {
  const std::string where = entity.empty() ? report.file : report.file + ": " + entity;
  report.diagnostics.push_back({severity, where, message});
}

std::string step_name(const Handle(Standard_Transient) & entity) {
  const auto item = Handle(StepRepr_RepresentationItem)::DownCast(entity);
  if (item.IsNull()) return "";
  const std::string own = text(item->Name());
  if (!own.empty()) return own;
  if (const auto edge = Handle(StepShape_EdgeCurve)::DownCast(entity)) return step_name(edge->EdgeGeometry());
  if (const auto curve = Handle(StepGeom_TrimmedCurve)::DownCast(entity))
    return step_name(curve->BasisCurve());
  return "";
}

std::string iges_name(const IGESData_IGESEntity& entity) {
  if (entity.HasName()) return text(entity.NameValue());
  return entity.HasShortLabel() ? text(entity.ShortLabel()) : "";
}

std::string entity_name(const Handle(Standard_Transient) & entity) {
  if (const auto iges = Handle(IGESData_IGESEntity)::DownCast(entity)) return iges_name(*iges);
  return step_name(entity);
}

// "#17 TrimmedCurve" in STEP, "D15 BSplineCurve" in IGES.
std::string entity_label(const Interface_InterfaceModel& model, const Handle(Standard_Transient) & entity) {
  const std::string_view type = entity->DynamicType()->Name();
  return text(model.StringLabel(entity)) + " " + std::string(type.substr(type.find('_') + 1));
}

void add_origins(const TopoDS_Shape& shape, TopAbs_ShapeEnum part, const Origin& origin, Origins& origins) {
  TopTools_IndexedMapOfShape parts;
  TopExp::MapShapes(shape, part, parts);
  for (int i = 1; i <= parts.Extent(); ++i) {
    Origin& known = origins[parts(i).TShape().get()];
    if (known.label.empty()) known.label = origin.label;
    if (known.name.empty()) known.name = origin.name;
    if (known.appearance.layer.empty()) known.appearance.layer = origin.appearance.layer;
    if (known.appearance.colour.empty()) known.appearance.colour = origin.appearance.colour;
    known.defective |= origin.defective && shape.ShapeType() != TopAbs_COMPOUND;
  }
}

// Whether a name of the entity is one of each of its edges: curves and sets of curves, not solids.
bool names_its_edges(const Handle(Standard_Transient) & entity, const TopoDS_Shape& result) {
  return result.ShapeType() >= TopAbs_WIRE || entity->IsKind(STANDARD_TYPE(StepShape_GeometricSet));
}

using Entities = std::unordered_set<const Standard_Transient*>;

// The B-spline curves of the file that cannot be, with a warning for each.
Entities defective_splines(const Interface_InterfaceModel& model, ImportReport& report) {
  Entities defective;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model.Value(i);
    const std::string defect = spline_defect(*entity);
    if (defect.empty()) continue;
    defective.insert(entity.get());
    add(report, Severity::warning, entity_label(model, entity),
        "skipped with all that is made of it: " + defect);
  }
  return defective;
}

// Whether the entity is one of `wanted`, or refers to one, directly or not.
bool refers_to(const Handle(Standard_Transient) & start, const Entities& wanted,
               const Interface_Graph& graph) {
  if (wanted.empty()) return false;
  Entities seen;
  std::vector<Handle(Standard_Transient)> open{start};
  while (!open.empty()) {
    const Handle(Standard_Transient) entity = open.back();
    open.pop_back();
    if (wanted.contains(entity.get())) return true;
    if (!seen.insert(entity.get()).second) continue;
    Interface_EntityIterator next = graph.Shareds(entity);
    for (next.Start(); next.More(); next.Next()) open.push_back(next.Value());
  }
  return false;
}

/// An entity of the file and the shape that was made of it.
struct Translated {
  Handle(Standard_Transient) entity;
  TopoDS_Shape shape;
};

// All of them, edges first and compounds last.
std::vector<Translated> translated_entities(const XSControl_Reader& reader) {
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  std::vector<Translated> all;
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const Handle(Standard_Transient) entity = process->Mapped(i);
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
    if (!shape.IsNull()) all.push_back({entity, shape});
  }
  std::stable_sort(all.begin(), all.end(), [](const Translated& a, const Translated& b) {
    return a.shape.ShapeType() > b.shape.ShapeType();
  });
  return all;
}

// Of an edge's own entity first, then of the smallest of those that hold it: wire or set, face, solid. Of a
// face's own entity, then of its shell or solid.
Origins origins_of_edges_and_faces(const XSControl_Reader& reader, ImportReport& report) {
  Origins origins;
  const Entities defective = defective_splines(*reader.Model(), report);
  const Interface_Graph& graph = reader.WS()->Graph();
  const Appearances appearances = appearances_of(*reader.WS());
  for (const auto& [entity, shape] : translated_entities(reader)) {
    const auto shown = appearances.find(entity.get());
    Origin origin;
    if (shown != appearances.end()) origin.appearance = shown->second;
    if (names_its_edges(entity, shape)) {
      origin.name = entity_name(entity);
      origin.label = entity_label(*reader.Model(), entity);
      origin.defective = refers_to(entity, defective, graph);
    }
    add_origins(shape, TopAbs_EDGE, origin, origins);
    if (shape.ShapeType() > TopAbs_FACE) continue;
    origin.name = entity_name(entity);
    origin.label = entity_label(*reader.Model(), entity);
    add_origins(shape, TopAbs_FACE, origin, origins);
  }
  return origins;
}

std::string edge_label(int number, const Origin& origin) {
  std::string label = "edge " + std::to_string(number);
  if (!origin.name.empty()) label += " '" + origin.name + "'";
  return origin.label.empty() ? label : label + " (" + origin.label + ")";
}

void note_approximation(const ImportedCurve& curve, const std::string& label, double tolerance,
                        ImportReport& report) {
  if (curve.exact) return;
  const Severity severity = curve.deviation <= tolerance ? Severity::note : Severity::warning;
  add(report, severity, label,
      "a curve of kind '" + curve.entity +
          "' has no exact NURBS form; approximated by a cubic with a deviation of " +
          std::to_string(curve.deviation / metres_per_millimetre) + " mm");
}

void add_edge(const TopoDS_Edge& edge, bool free, const std::string& label, const Origin& origin,
              double tolerance, ImportReport& report) {
  try {
    OCC_CATCH_SIGNALS
    ImportedCurve curve = imported_curve(edge, tolerance);
    curve.name = origin.name;
    curve.layer = origin.appearance.layer;
    curve.colour = origin.appearance.colour;
    curve.free = free;
    note_approximation(curve, label, tolerance, report);
    report.curves.push_back(std::move(curve));
  } catch (const Standard_Failure& e) {
    add(report, Severity::warning, label, std::string("skipped, no valid curve: ") + e.GetMessageString());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    add(report, Severity::warning, label, std::string("skipped, no valid curve: ") + e.what());
  }
}

// Centre lines stand after the curves of the file, whose numbers they leave as they are.
void add_centre_lines(const TopoDS_Shape& shape, const Origins& origins, double tolerance,
                      ImportReport& report) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  CentreLines found = centre_lines(shape, tolerance);
  for (CentreLine& line : found.lines) {
    const auto known = origins.find(faces(line.face).TShape().get());
    if (known != origins.end()) {
      if (known->second.defective) continue;
      line.curve.name = known->second.name;
      line.curve.layer = known->second.appearance.layer;
      line.curve.colour = known->second.appearance.colour;
    }
    report.curves.push_back(std::move(line.curve));
  }
  for (const std::string& remark : found.remarks) add(report, Severity::note, "", remark);
}

void add_edges(const XSControl_Reader& reader, double tolerance, ImportReport& report) {
  const TopoDS_Shape shape = reader.OneShape();
  if (shape.IsNull()) return;
  const Origins origins = origins_of_edges_and_faces(reader, report);
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of_edges);
  for (int i = 1; i <= faces_of_edges.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(faces_of_edges.FindKey(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    const auto known = origins.find(edge.TShape().get());
    const Origin origin = known == origins.end() ? Origin{} : known->second;
    if (origin.defective) continue;
    add_edge(edge, faces_of_edges(i).IsEmpty(), edge_label(i, origin), origin, tolerance, report);
  }
  add_centre_lines(shape, origins, tolerance, report);
}

// What OpenCASCADE failed to read or to translate.
void add_failures(const Interface_CheckIterator& checks, const Interface_InterfaceModel& model,
                  ImportReport& report) {
  Interface_CheckIterator failures = checks.Extract(Interface_CheckFail);
  int count = 0;
  for (failures.Start(); failures.More(); failures.Next()) {
    if (++count > most_reported_failures) continue;
    const auto entity = model.NbEntities() >= failures.Number() && failures.Number() > 0
                            ? model.Value(failures.Number())
                            : Handle(Standard_Transient)();
    add(report, Severity::warning, entity.IsNull() ? "" : entity_label(model, entity),
        std::string("OpenCASCADE: ") + failures.Value()->CFail(1));
  }
  if (count > most_reported_failures) {
    add(report, Severity::warning, "",
        std::to_string(count - most_reported_failures) + " more such failures");
  }
}

void transfer(XSControl_Reader& reader, double tolerance, ImportReport& report) {
  reader.TransferRoots();
  add_edges(reader, tolerance, report);
  const Handle(XSControl_WorkSession) session = reader.WS();
  add_failures(session->TransferReader()->TransientProcess()->CheckList(Standard_True), *reader.Model(),
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

// Whether numbers of a curve may be lost with what OpenCASCADE could not read in the entity: not with a name.
bool matters(const Standard_Transient& entity, std::string_view failure) {
  const bool step = !entity.IsKind(STANDARD_TYPE(IGESData_IGESEntity));
  const bool geometry = std::string_view(entity.DynamicType()->Name()).starts_with("StepGeom_");
  return !step || (geometry && failure.find("(name)") == std::string_view::npos);
}

// Entities that are there in part only: OpenCASCADE goes on with zeros.
void add_damaged_entities(const Interface_InterfaceModel& model, ImportReport& report) {
  int count = 0;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(Interface_Check) check = model.Check(i, /*syntactic=*/Standard_True);
    if (!check->HasFailed() || !matters(*model.Value(i), check->CFail(1))) continue;
    if (++count > most_reported_failures) continue;
    add(report, Severity::warning, entity_label(model, model.Value(i)),
        std::string("damaged, and curves made of it may be wrong: ") + check->CFail(1));
  }
  if (count > most_reported_failures) {
    add(report, Severity::warning, "",
        std::to_string(count - most_reported_failures) + " more damaged entities");
  }
}

void read(XSControl_Reader& reader, const std::filesystem::path& file, ImportReport& report) {
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone || reader.Model().IsNull()) {
    throw std::runtime_error("OpenCASCADE cannot read it: the syntax is damaged; export or copy it again");
  }
  check_syntax(*reader.Model());
  add_damaged_entities(*reader.Model(), report);
}

// -------------------------------------------------------------------------------------------------------
// units

struct NamedUnit {
  std::string_view name;
  double in_metres;
};
constexpr std::array<NamedUnit, 9> named_units{{{"m", 1},
                                                {"mm", 1e-3},
                                                {"cm", 1e-2},
                                                {"inch", 0.0254},
                                                {"ft", 0.3048},
                                                {"um", 1e-6},
                                                {"km", 1e3},
                                                {"mile", 1609.344},
                                                {"mil", 2.54e-5}}};

bool nearly_equal(double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(b); }

void report_unit(double in_metres, ImportReport& report) {
  report.unit_in_metres = in_metres;
  report.unit = std::to_string(in_metres) + " m";
  for (const NamedUnit& unit : named_units) {
    if (!nearly_equal(in_metres, unit.in_metres)) continue;
    report.unit = unit.name;
    report.unit_in_metres = unit.in_metres;
  }
}

// -------------------------------------------------------------------------------------------------------
// STEP

Handle(StepRepr_GlobalUnitAssignedContext) units_of(const Handle(Standard_Transient) & entity) {
  if (const auto context =
          Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(entity)) {
    return context->GlobalUnitAssignedContext();
  }
  if (const auto context =
          Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext)::DownCast(entity)) {
    return context->GlobalUnitAssignedContext();
  }
  return Handle(StepRepr_GlobalUnitAssignedContext)::DownCast(entity);
}

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
    const Handle(StepRepr_GlobalUnitAssignedContext) units = units_of(model.Value(i));
    if (units.IsNull()) continue;
    STEPConstruct_UnitContext factors;
    factors.ComputeFactors(units);
    if (!factors.LengthDone()) continue;
    contexts.length_units.insert(factors.LengthFactor() * metres_per_millimetre);
    const Handle(StepRepr_GlobalUncertaintyAssignedContext) uncertainty = uncertainty_of(model.Value(i));
    if (uncertainty.IsNull()) continue;
    factors.ComputeTolerance(uncertainty);
    if (!factors.HasUncertainty()) continue;
    // OpenCASCADE leaves the number in the context's own length unit.
    const double resolution = factors.Uncertainty() * factors.LengthFactor() * metres_per_millimetre;
    if (std::isfinite(resolution)) contexts.resolution = std::max(contexts.resolution, resolution);
  }
  return contexts;
}

void report_step_unit(const Interface_InterfaceModel& model, ImportReport& report) {
  const StepContexts contexts = contexts_of(model);
  const std::set<double>& units = contexts.length_units;
  report.resolution = contexts.resolution;
  if (units.empty()) {
    add(report, Severity::warning, "", "the file declares no length unit; millimetres are assumed");
  }
  if (units.size() > 1) {
    add(report, Severity::note, "",
        "the file has parts in different length units; each is scaled by its own");
  }
  report_unit(units.empty() ? metres_per_millimetre : *units.begin(), report);
}

void read_step(const std::filesystem::path& file, double tolerance, ImportReport& report) {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  STEPControl_Reader reader;
  read(reader, file, report);
  report_step_unit(*reader.Model(), report);
  transfer(reader, tolerance, report);
}

// -------------------------------------------------------------------------------------------------------
// IGES

void compare_units(const IgesGlobal& ours, const IGESData_GlobalSection& theirs) {
  const double in_metres = theirs.UnitValue() * metres_per_millimetre;
  if (nearly_equal(in_metres, ours.unit_in_metres)) return;
  throw std::runtime_error("the Global section says that the length unit is " +
                           std::to_string(ours.unit_in_metres) + " m, but OpenCASCADE takes it for " +
                           std::to_string(in_metres) +
                           " m; correct the Global section (Hollerith counts, parameters 14 and 15)");
}

void read_iges(const std::filesystem::path& file, const std::string& content, double tolerance,
               ImportReport& report) {
  const IgesGlobal global = parse_iges_global(content);
  report_unit(global.unit_in_metres, report);
  if (global.scale != 1) {
    add(report, Severity::note, "",
        "the model space scale " + std::to_string(global.scale) + " (drawing scale) is not applied");
  }
  const std::string miscounted = miscounted_lines(content);
  if (!miscounted.empty()) add(report, Severity::warning, "", miscounted);
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  // Only after Init: before it, the parameter is unknown and curves are split where they are only C0.
  if (!Interface_Static::SetIVal("read.iges.bspline.continuity", 0)) {
    throw std::runtime_error("OpenCASCADE refuses read.iges.bspline.continuity = 0");
  }
  IGESControl_Reader reader;
  read(reader, file, report);
  compare_units(global, reader.IGESModel()->GlobalSection());
  const double resolution = reader.IGESModel()->GlobalSection().Resolution();
  if (std::isfinite(resolution) && resolution > 0) report.resolution = resolution * global.unit_in_metres;
  transfer(reader, tolerance, report);
}

void read_format(const std::filesystem::path& file, const std::string& content, CadFormat format,
                 double tolerance, ImportReport& report) {
  if (format == CadFormat::step) {
    read_step(file, tolerance, report);
  } else {
    read_iges(file, content, tolerance, report);
  }
}

}  // namespace

ImportReport read_cad_file(const std::filesystem::path& file, const std::string& content, CadFormat format,
                           double tolerance) {
  ImportReport report;
  report.file = file.string();
  OSD::SetSignal(Standard_False);
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  try {
    OCC_CATCH_SIGNALS
    read_format(file, content, format, tolerance, report);
  } catch (const Standard_Failure& e) {
    add(report, Severity::error, "",
        std::string("OpenCASCADE failed (") + e.DynamicType()->Name() + " " + e.GetMessageString() +
            "); the file is damaged or uses what OpenCASCADE cannot read; export it again");
  } catch (const std::runtime_error& e) {
    add(report, Severity::error, "", e.what());
  }
  if (report.ok() && report.curves.empty()) {
    add(report, Severity::error, "",
        "no curve in the file; expected at least one edge or free curve (line, conic, B-spline)");
  }
  return report;
}

}  // namespace nurbeam
