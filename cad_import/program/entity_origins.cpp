#include "cad_import/program/entity_origins.h"

#include <IGESData_IGESEntity.hxx>
#include <IGESData_NameEntity.hxx>
#include <IGESDraw_CircArraySubfigure.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <StepData_UndefinedEntity.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_GeometricSet.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <string_view>
#include <vector>

#include "cad_import/files/tolerant_text.h"
#include "cad_import/occt/spline_defect.h"

namespace nurbeam {
namespace {

// What an edge or a trimmed curve without a name is made of may have one.
Handle(Standard_Transient) below(const Handle(Standard_Transient) & entity) {
  if (const auto edge = Handle(StepShape_EdgeCurve)::DownCast(entity)) return edge->EdgeGeometry();
  if (const auto curve = Handle(StepGeom_TrimmedCurve)::DownCast(entity)) return curve->BasisCurve();
  return nullptr;
}

std::string step_name(Handle(Standard_Transient) entity) {
  constexpr int deepest_name = 100;
  for (int depth = 0; depth < deepest_name; ++depth, entity = below(entity)) {
    const auto item = Handle(StepRepr_RepresentationItem)::DownCast(entity);
    if (item.IsNull()) return "";
    if (std::string own = trimmed_text(item->Name()); !own.empty()) return own;
  }
  return "";
}

// Its name property, else its label, with the subscript if that counts: "Cable", "Cable(2)".
std::string iges_name(const IGESData_IGESEntity& entity) {
  const Handle(Standard_Type) name = STANDARD_TYPE(IGESData_NameEntity);
  if (entity.NbTypedProperties(name) > 0)
    if (const auto property = Handle(IGESData_NameEntity)::DownCast(entity.TypedProperty(name)))
      return trimmed_text(property->Value());
  if (!entity.HasShortLabel()) return "";
  const std::string label = trimmed_text(entity.ShortLabel());
  const bool counts = entity.HasSubScriptNumber() && entity.SubScriptNumber() > 0;
  return counts ? label + "(" + std::to_string(entity.SubScriptNumber()) + ")" : label;
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
    known.appearance.hidden |= origin.appearance.hidden;
    known.left_out |= origin.left_out && shape.ShapeType() != TopAbs_COMPOUND;
  }
}

// Whether a name of the entity is one of each of its edges: curves and sets of curves, not solids.
bool names_its_edges(const Handle(Standard_Transient) & entity, const TopoDS_Shape& result) {
  return result.ShapeType() >= TopAbs_WIRE || entity->IsKind(STANDARD_TYPE(StepShape_GeometricSet));
}

// The B-spline curves of the file that cannot be, with a warning for each.
EntitySet defective_splines(const Interface_InterfaceModel& model, ImportReport& report) {
  EntitySet defective;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model.Value(i);
    const std::optional<std::string> defect = spline_defect(*entity);
    if (!defect) continue;
    defective.insert(entity.get());
    add_diagnostic(report, Severity::warning, entity_label(model, entity),
                   "skipped with all that is made of it: " + *defect);
  }
  return defective;
}

// Whether the entity is one of `wanted`, or refers to one, directly or not.
bool refers_to(const Handle(Standard_Transient) & start, const EntitySet& wanted,
               const Interface_Graph& graph) {
  if (wanted.empty()) return false;
  EntitySet seen;
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

// What circular arrays (414) repeat, which OpenCASCADE takes for curves of the file besides.
EntitySet repeated_entities(const Interface_InterfaceModel& model, const Interface_Graph& graph) {
  EntitySet repeated;
  std::vector<Handle(Standard_Transient)> open;
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (const auto array = Handle(IGESDraw_CircArraySubfigure)::DownCast(model.Value(i)))
      open.push_back(array->BaseEntity());
  while (!open.empty()) {
    const Handle(Standard_Transient) entity = open.back();
    open.pop_back();
    if (entity.IsNull() || !repeated.insert(entity.get()).second) continue;
    const auto next = references_of(entity, graph);
    open.insert(open.end(), next.begin(), next.end());
  }
  return repeated;
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

}  // namespace

std::string trimmed_text(const Handle(TCollection_HAsciiString) & value) {
  if (value.IsNull()) return "";
  std::string result = value->ToCString();
  result.erase(0, result.find_first_not_of(' '));
  return as_utf8(result.erase(result.find_last_not_of(' ') + 1));
}

std::string entity_name(const Handle(Standard_Transient) & entity) {
  if (const auto iges = Handle(IGESData_IGESEntity)::DownCast(entity)) return iges_name(*iges);
  return step_name(entity);
}

std::string entity_label(const Interface_InterfaceModel& model, const Handle(Standard_Transient) & entity) {
  const auto unknown = Handle(StepData_UndefinedEntity)::DownCast(entity);
  const std::string_view type = unknown.IsNull() ? entity->DynamicType()->Name() : unknown->StepType();
  return trimmed_text(model.StringLabel(entity)) + " " + std::string(type.substr(type.find('_') + 1));
}

std::vector<Handle(Standard_Transient)> references_of(const Handle(Standard_Transient) & entity,
                                                      const Interface_Graph& graph) {
  std::vector<Handle(Standard_Transient)> references;
  Interface_EntityIterator next = graph.Shareds(entity);
  for (next.Start(); next.More(); next.Next()) references.push_back(next.Value());
  if (const auto array = Handle(IGESDraw_CircArraySubfigure)::DownCast(entity))
    if (!array->BaseEntity().IsNull()) references.push_back(array->BaseEntity());
  return references;
}

Origins origins_of_edges_and_faces(const XSControl_Reader& reader, const EntitySet& refused,
                                   ImportReport& report) {
  Origins origins;
  EntitySet defective = defective_splines(*reader.Model(), report);
  defective.insert(refused.begin(), refused.end());
  const Interface_Graph& graph = reader.WS()->Graph();
  const EntitySet repeated = repeated_entities(*reader.Model(), graph);
  const Appearances appearances = appearances_of(*reader.WS());
  for (const auto& [entity, shape] : translated_entities(reader)) {
    const auto shown = appearances.find(entity.get());
    Origin origin;
    if (shown != appearances.end()) origin.appearance = shown->second;
    if (names_its_edges(entity, shape)) {
      origin.name = entity_name(entity);
      origin.label = entity_label(*reader.Model(), entity);
      origin.left_out = repeated.contains(entity.get()) || refers_to(entity, defective, graph);
    }
    add_origins(shape, TopAbs_EDGE, origin, origins);
    if (shape.ShapeType() > TopAbs_FACE) continue;
    origin.name = entity_name(entity);
    origin.label = entity_label(*reader.Model(), entity);
    add_origins(shape, TopAbs_FACE, origin, origins);
  }
  return origins;
}

void add_diagnostic(ImportReport& report, Severity severity, const std::string& entity,
                    const std::string& message) {
  const std::string where = entity.empty() ? report.file : report.file + ": " + entity;
  report.diagnostics.push_back({severity, where, message});
}

}  // namespace nurbeam
