#include "cad_import/program/lost_curves.h"

#include <IGESData_IGESEntity.hxx>
#include <IGESGeom_ConicArc.hxx>
#include <Interface_Check.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <StepData_UndefinedEntity.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_Pcurve.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_GeometricSet.hxx>
#include <StepShape_PolyLoop.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>
#include <set>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "cad_import/iges/hyperbola.h"
#include "cad_import/occt/spline_defect.h"
#include "cad_import/program/step_curve.h"

namespace nurbeam {
namespace {

constexpr int most_named = 20;

using Entity = Handle(Standard_Transient);
using Entities = std::unordered_set<const Standard_Transient*>;

bool names_a_curve(std::string_view keyword) {
  for (const std::string_view part : {"CURVE", "CLOTHOID", "SPIRAL", "POLYLINE", "SEGMENT"})
    if (keyword.find(part) != std::string_view::npos && !keyword.ends_with("STYLE")) return true;
  return false;
}

bool names_a_curve_set(std::string_view type) { return type == "StepVisual_TessellatedCurveSet"; }

bool is_curve(const Entity& entity) {
  if (const auto unknown = Handle(StepData_UndefinedEntity)::DownCast(entity))
    return !unknown->IsSub() && names_a_curve(unknown->StepType());
  if (const auto iges = Handle(IGESData_IGESEntity)::DownCast(entity)) {
    const int type = iges->TypeNumber();
    return std::set{100, 102, 104, 106, 110, 112, 126, 130, 412, 414}.contains(type) &&
           !(type == 106 && iges->FormNumber() >= 20);  // centre, section and witness lines of a drawing
  }
  return entity->IsKind(STANDARD_TYPE(StepGeom_Curve)) || entity->IsKind(STANDARD_TYPE(StepShape_PolyLoop)) ||
         entity->IsKind(STANDARD_TYPE(StepShape_EdgeCurve)) ||
         names_a_curve_set(entity->DynamicType()->Name());
}

// All that these entities refer to, directly or not, is added; they themselves are only where `with_itself`.
void add_references(const std::vector<Entity>& from, bool with_itself, const Interface_Graph& graph,
                    Entities& seen) {
  std::vector<Entity> open = from;
  if (!with_itself) {
    open.clear();
    for (const Entity& entity : from)
      for (Interface_EntityIterator next = graph.Shareds(entity); next.More(); next.Next())
        open.push_back(next.Value());
  }
  while (!open.empty()) {
    const Entity entity = open.back();
    open.pop_back();
    if (!seen.insert(entity.get()).second) continue;
    for (Interface_EntityIterator next = graph.Shareds(entity); next.More(); next.Next())
      open.push_back(next.Value());
  }
}

// What the edges, wires and faces were made of.
std::vector<Entity> origins_of_shapes(const XSControl_Reader& reader) {
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  std::vector<Entity> found;
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const Entity entity = process->Mapped(i);
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
    if (shape.IsNull() || entity->IsKind(STANDARD_TYPE(StepShape_GeometricSet))) continue;
    const TopAbs_ShapeEnum kind = shape.ShapeType();
    if (kind == TopAbs_EDGE || kind == TopAbs_WIRE || kind == TopAbs_FACE) found.push_back(entity);
  }
  return found;
}

// Of which there is a curve all the same.
Handle(IGESGeom_ConicArc) hyperbola_of(const Entity& entity) {
  const auto conic = Handle(IGESGeom_ConicArc)::DownCast(entity);
  return !conic.IsNull() && conic->IsFromHyperbola() ? conic : nullptr;
}

bool failed_to_translate(const Entity& entity, const XSControl_Reader& reader) {
  const Handle(Transfer_Binder) result = reader.WS()->TransferReader()->TransientProcess()->Find(entity);
  return !result.IsNull() && result->Check()->HasFailed();
}

// The curves that no shape was made of, without those that another of them refers to.
std::vector<Entity> lost_curves(const XSControl_Reader& reader) {
  const Interface_InterfaceModel& model = *reader.Model();
  const Interface_Graph& graph = reader.WS()->Graph();
  Entities used;
  add_references(origins_of_shapes(reader), true, graph, used);
  std::vector<Entity> lost;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Entity entity = model.Value(i);
    const bool told = spline_defect(*entity) || model.Check(i, /*syntactic=*/Standard_True)->HasFailed() ||
                      (failed_to_translate(entity, reader) && hyperbola_of(entity).IsNull());
    if (is_curve(entity) && !used.contains(entity.get()) && !told) lost.push_back(entity);
  }
  Entities below;
  add_references(lost, false, graph, below);
  std::erase_if(lost, [&](const Entity& entity) { return below.contains(entity.get()); });
  return lost;
}

// Whether the entities of the file have their places in it: no part is placed by another.
bool is_one_part(const Interface_InterfaceModel& model) {
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (model.Value(i)->IsKind(STANDARD_TYPE(StepRepr_NextAssemblyUsageOccurrence)) ||
        model.Value(i)->IsKind(STANDARD_TYPE(StepRepr_MappedItem)))
      return false;
  return true;
}

// Why the curve was not added; nothing if it was.
std::optional<std::string> obstacle(const Entity& entity, const Interface_Graph& graph, double tolerance,
                                    ImportReport& report) {
  const Handle(IGESGeom_ConicArc) hyperbola = hyperbola_of(entity);
  const bool iges = entity->IsKind(STANDARD_TYPE(IGESData_IGESEntity));
  if (!iges && graph.Sharings(entity).NbEntities() == 0) return "no representation holds it";
  if (entity->IsKind(STANDARD_TYPE(StepGeom_Pcurve))) return "it lies in the parameters of a surface";
  if (hyperbola.IsNull() && !entity->IsKind(STANDARD_TYPE(StepGeom_Curve)) &&
      !entity->IsKind(STANDARD_TYPE(StepShape_PolyLoop)) &&
      !entity->IsKind(STANDARD_TYPE(StepShape_EdgeCurve)))
    return "OpenCASCADE makes nothing of its kind";
  try {
    OCC_CATCH_SIGNALS
    ImportedCurve curve =
        hyperbola.IsNull()
            ? step_curve(entity, report.unit_in_metres, tolerance)
            : ImportedCurve{.entity = "hyperbola", .curve = hyperbola_arc(*hyperbola, report.unit_in_metres)};
    curve.name = entity_name(entity);
    report.curves.push_back(std::move(curve));
    return std::nullopt;
  } catch (const Standard_Failure& e) {
    return std::string("OpenCASCADE makes no curve of it: ") + e.DynamicType()->Name() + " " +
           e.GetMessageString();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    return e.what();
  }
}

}  // namespace

Recovered add_lost_curves(const XSControl_Reader& reader, double tolerance, ImportReport& report) {
  const Interface_InterfaceModel& model = *reader.Model();
  const bool placed = is_one_part(model);
  int unnamed = 0, named = 0;
  Recovered recovered;
  for (const Entity& entity : lost_curves(reader)) {
    const std::optional<std::string> why = placed ? obstacle(entity, reader.WS()->Graph(), tolerance, report)
                                                  : "its place in the assembly is not known";
    if (!why) {
      recovered.insert(entity.get());
      continue;
    }
    if (++named > most_named) {
      ++unnamed;
      continue;
    }
    const std::string name = entity_name(entity);
    add_diagnostic(report, Severity::warning,
                   entity_label(model, entity) + (name.empty() ? "" : " '" + name + "'"),
                   "not read: " + *why);
  }
  if (unnamed > 0)
    add_diagnostic(report, Severity::warning, "", std::to_string(unnamed) + " more curves were not read");
  return recovered;
}

}  // namespace nurbeam
