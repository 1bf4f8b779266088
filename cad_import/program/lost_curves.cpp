#include "cad_import/program/lost_curves.h"

#include <IGESBasic_SubfigureDef.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESDraw_CircArraySubfigure.hxx>
#include <IGESDraw_RectArraySubfigure.hxx>
#include <Interface_Check.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepData_UndefinedEntity.hxx>
#include <StepGeom_Circle.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_Pcurve.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepRepr_Representation.hxx>
#include <StepRepr_RepresentationRelationshipWithTransformation.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_GeometricSet.hxx>
#include <StepShape_PolyLoop.hxx>
#include <StepShape_ShapeRepresentation.hxx>
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

#include "cad_import/occt/appearance.h"
#include "cad_import/occt/placed_curve.h"
#include "cad_import/occt/spline_defect.h"
#include "cad_import/program/array_curves.h"
#include "cad_import/program/part_places.h"
#include "cad_import/program/step_curve.h"
#include "cad_import/report/length_unit.h"
#include "cad_import/step/step_units.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

constexpr int most_named = 20;

constexpr const char* without_place = "its place or its unit in the assembly is not known";

using Entity = Handle(Standard_Transient);

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
                    EntitySet& seen) {
  std::vector<Entity> open = from;
  if (!with_itself) {
    open.clear();
    for (const Entity& entity : from) {
      const auto next = references_of(entity, graph);
      open.insert(open.end(), next.begin(), next.end());
    }
  }
  while (!open.empty()) {
    const Entity entity = open.back();
    open.pop_back();
    if (!seen.insert(entity.get()).second) continue;
    const auto next = references_of(entity, graph);
    open.insert(open.end(), next.begin(), next.end());
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

bool is_array(const Entity& entity) {
  return entity->IsKind(STANDARD_TYPE(IGESDraw_RectArraySubfigure)) ||
         entity->IsKind(STANDARD_TYPE(IGESDraw_CircArraySubfigure));
}

bool failed_to_translate(const Entity& entity, const XSControl_Reader& reader) {
  const Handle(Transfer_Binder) result = reader.WS()->TransferReader()->TransientProcess()->Find(entity);
  return !result.IsNull() && result->Check()->HasFailed();
}

// Whether a set or the representation of a shape holds it by itself.
bool is_held(const Entity& entity, const Interface_Graph& graph) {
  for (Interface_EntityIterator next = graph.Sharings(entity); next.More(); next.Next())
    if (next.Value()->IsKind(STANDARD_TYPE(StepShape_GeometricSet)) ||
        next.Value()->IsKind(STANDARD_TYPE(StepShape_ShapeRepresentation)))
      return true;
  return false;
}

// The curves that no shape was made of, without those that another of them refers to and nobody
// else holds, or that were told of.
std::vector<Entity> lost_curves(const XSControl_Reader& reader, const RestatedCurves& restated) {
  const Interface_InterfaceModel& model = *reader.Model();
  const Interface_Graph& graph = reader.WS()->Graph();
  const std::vector<Entity> origins = origins_of_shapes(reader);
  EntitySet used, made;
  for (const Entity& origin : origins) made.insert(origin.get());
  const auto stands_alone = [&](const Entity& entity) {
    return !made.contains(entity.get()) && is_held(entity, graph);
  };
  add_references(origins, true, graph, used);
  add_references({restated.parents.begin(), restated.parents.end()}, true, graph, used);
  add_references({restated.refused.begin(), restated.refused.end()}, true, graph, used);
  std::vector<Entity> lost;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Entity entity = model.Value(i);
    const bool told = restated.refused.contains(entity.get()) || spline_defect(*entity) ||
                      model.Check(i, /*syntactic=*/Standard_True)->HasFailed() ||
                      (failed_to_translate(entity, reader) && !is_array(entity));
    if (is_curve(entity) && !told && (!used.contains(entity.get()) || stands_alone(entity)))
      lost.push_back(entity);
  }
  EntitySet below;
  add_references(lost, false, graph, below);
  std::erase_if(lost,
                [&](const Entity& entity) { return below.contains(entity.get()) && !stands_alone(entity); });
  return lost;
}

// Whether the numbers of the file are places in it: no part is placed by another, and all have one unit.
bool has_one_part(const Interface_InterfaceModel& model) {
  if (length_units_of(model).size() > 1) return false;
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (model.Value(i)->IsKind(STANDARD_TYPE(StepRepr_NextAssemblyUsageOccurrence)) ||
        model.Value(i)->IsKind(STANDARD_TYPE(StepRepr_MappedItem)) ||
        model.Value(i)->IsKind(STANDARD_TYPE(StepRepr_RepresentationRelationshipWithTransformation)))
      return false;
  return true;
}

// The part of an IGES file that other ones place: a subfigure (308) that instances (408) refer to.
bool is_in_subfigure(const Entity& start, const Interface_Graph& graph) {
  EntitySet seen;
  std::vector<Entity> open{start};
  while (!open.empty()) {
    const Entity entity = open.back();
    open.pop_back();
    if (entity->IsKind(STANDARD_TYPE(IGESBasic_SubfigureDef))) return true;
    if (!seen.insert(entity.get()).second) continue;
    for (Interface_EntityIterator next = graph.Sharings(entity); next.More(); next.Next())
      open.push_back(next.Value());
  }
  return false;
}

// Why there is no curve of the entity; nothing if there may be.
std::optional<std::string> obstacle(const Entity& entity, const Interface_Graph& graph) {
  if (entity->IsKind(STANDARD_TYPE(IGESData_IGESEntity))) {
    if (!is_array(entity)) return "OpenCASCADE makes nothing of its kind";
    if (is_in_subfigure(entity, graph)) return "it stands in a subfigure (308), which others place";
    return std::nullopt;
  }
  if (graph.Sharings(entity).NbEntities() == 0) return "no representation holds it";
  if (entity->IsKind(STANDARD_TYPE(StepGeom_Pcurve))) return "it lies in the parameters of a surface";
  if (!entity->IsKind(STANDARD_TYPE(StepGeom_Curve)) && !entity->IsKind(STANDARD_TYPE(StepShape_PolyLoop)) &&
      !entity->IsKind(STANDARD_TYPE(StepShape_EdgeCurve)))
    return "OpenCASCADE makes nothing of its kind";
  return std::nullopt;
}

// Why OpenCASCADE makes no curve of a circle, or of a piece of one.
std::string refusal_of(const Entity& entity, const Standard_Failure& failure) {
  const auto piece = Handle(StepGeom_TrimmedCurve)::DownCast(entity);
  const auto circle =
      Handle(StepGeom_Circle)::DownCast(piece.IsNull() ? entity : Entity(piece->BasisCurve()));
  if (!circle.IsNull() && !(circle->Radius() > 0))
    return "its radius is " + text_of(circle->Radius()) + "; it must be positive";
  const std::string why = failure.GetMessageString();
  return "OpenCASCADE makes no curve of its numbers" + (why.empty() ? "" : ": " + why);
}

/// The coordinates that an entity is in.
struct Coordinates {
  std::vector<PartPlace> places;  // of its part
  double unit;                    // [m]
};

// How the file shows it, else what it stands in: a set, a wireframe.
Appearance appearance_of(const Entity& entity, const XSControl_Reader& reader) {
  const Appearances appearances = appearances_of(*reader.WS());
  EntitySet seen;
  std::vector<Entity> open{entity};
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (const auto shown = appearances.find(open[i].get()); shown != appearances.end()) return shown->second;
    for (Interface_EntityIterator next = reader.WS()->Graph().Sharings(open[i]); next.More(); next.Next())
      if (!next.Value()->IsKind(STANDARD_TYPE(StepRepr_Representation)) &&
          seen.insert(next.Value().get()).second)
        open.push_back(next.Value());
  }
  return {};
}

std::vector<ImportedCurve> curves_of(const Entity& entity, const XSControl_Reader& reader,
                                     const RestatedCurves& restated, double unit, double tolerance) {
  if (is_array(entity))
    return array_curves(Handle(IGESData_IGESEntity)::DownCast(entity), reader, restated, unit, tolerance);
  std::vector<ImportedCurve> curves = step_curves(entity, unit, tolerance);
  const Appearance appearance = appearance_of(entity, reader);
  for (ImportedCurve& curve : curves) {
    curve.name = entity_name(entity);
    curve.layer = appearance.layer;
    curve.colour = appearance.colour;
    curve.hidden = appearance.hidden;
  }
  return curves;
}

// Why no curve was added; nothing if one was. `unit`: of the entity's coordinates [m].
std::optional<std::string> add_curves_of(const Entity& entity, const XSControl_Reader& reader,
                                         const RestatedCurves& restated, const Coordinates& in,
                                         double tolerance, ImportReport& report) {
  if (auto reason = obstacle(entity, reader.WS()->Graph())) return reason;
  if (in.places.empty()) return without_place;
  try {
    OCC_CATCH_SIGNALS
    const std::vector<ImportedCurve> curves = curves_of(entity, reader, restated, in.unit, tolerance);
    for (const PartPlace& place : in.places)
      for (ImportedCurve curve : curves) {
        if (place.to_world.Form() != gp_Identity)
          curve.curve = placed(curve.curve, in_metres(place.to_world, metres_per_millimetre));
        curve.part = place.name.path;
        if (curve.name.empty()) curve.name = place.name.own;
        report.curves.push_back(std::move(curve));
      }
    return std::nullopt;
  } catch (const Standard_Failure& e) {
    return refusal_of(entity, e);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    return e.what();
  }
}

std::string label_of(const Interface_InterfaceModel& model, const Entity& entity) {
  const std::string name = entity_name(entity);
  return entity_label(model, entity) + (name.empty() ? "" : " '" + name + "'");
}

// The part of a file that has one only; "" of others.
std::string only_part(const Interface_InterfaceModel& model) {
  std::string part;
  for (int i = 1, count = 0; i <= model.NbEntities(); ++i)
    if (const auto definition = Handle(StepBasic_ProductDefinition)::DownCast(model.Value(i)))
      part = ++count == 1 ? product_name(definition) : "";
  return part;
}

class Whole {
 public:
  Whole(const XSControl_Reader& reader, const RestatedCurves& restated, double unit)
      : reader_(reader), restated_(restated), unit_(unit), is_one_part_(has_one_part(*reader.Model())) {
    const std::string part = only_part(*reader.Model());
    if (!is_one_part_) return;
    own_ = {{gp_Trsf(), {part, part}}};
    const Interface_InterfaceModel& model = *reader.Model();
    for (int i = 1; i <= model.NbEntities() && context_.IsNull(); ++i)
      if (length_unit_of(model.Value(i))) context_ = model.Value(i);
  }

  Coordinates of(const Entity& entity) {
    if (is_one_part_) {
      if (!context_.IsNull()) use_units_of(context_);  // the transfer leaves others behind
      return {own_, unit_};
    }
    const std::optional<Holder> holder = holder_of(entity, reader_.WS()->Graph());
    const std::optional<double> unit = holder ? length_unit_of(holder->context) : std::nullopt;
    if (!unit) return {};
    use_units_of(holder->context);
    if (!parts_) parts_.emplace(reader_, true_places(reader_, restated_));
    return {parts_->of(holder->part), *unit};
  }

 private:
  const XSControl_Reader& reader_;
  const RestatedCurves& restated_;
  double unit_;
  bool is_one_part_;
  Entity context_;  // of the units of one part; null where there are none
  std::vector<PartPlace> own_;
  std::optional<PartPlaces> parts_;
};

}  // namespace

LostCurves add_lost_curves(const XSControl_Reader& reader, const RestatedCurves& restated, double tolerance,
                           ImportReport& report) {
  const Interface_InterfaceModel& model = *reader.Model();
  Whole whole(reader, restated, report.unit_in_metres);
  int named = 0, without_place_count = 0;
  std::string first_without_place;
  LostCurves found;
  for (const Entity& entity : lost_curves(reader, restated)) {
    const std::size_t first = report.curves.size();
    const Coordinates in = whole.of(entity);
    const auto why = add_curves_of(entity, reader, restated, in, tolerance, report);
    if (!why) {
      RecoveredCurve& recovered = found.recovered[entity.get()];
      recovered.first = first;
      for (const PartPlace& place : in.places) recovered.places.push_back(place.to_world);
      recovered.at_each = in.places.empty() ? 0 : (report.curves.size() - first) / in.places.size();
      continue;
    }
    found.named.insert(entity.get());
    if (*why == without_place && ++without_place_count > 1) continue;
    if (*why == without_place)
      first_without_place = label_of(model, entity);
    else if (++named <= most_named)
      add_diagnostic(report, Severity::warning, label_of(model, entity), "not read: " + *why);
  }
  if (without_place_count > 0)
    add_diagnostic(
        report, Severity::warning, first_without_place,
        "not read: " + std::string(without_place) + "; so are " + std::to_string(without_place_count) +
            " curve(s) in all, of product definitions that nothing places: export the part that has "
            "them by itself, or place it in the assembly");
  if (named > most_named)
    add_diagnostic(report, Severity::warning, "",
                   std::to_string(named - most_named) + " more curves were not read");
  return found;
}

}  // namespace nurbeam
