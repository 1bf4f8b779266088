#include "cad_import/program/part_places.h"

#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <StepRepr_ProductDefinitionShape.hxx>
#include <StepRepr_RepresentationContext.hxx>
#include <StepRepr_RepresentationMap.hxx>
#include <StepRepr_ShapeRepresentationRelationship.hxx>
#include <StepRepr_ShapeRepresentationRelationshipWithTransformation.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <unordered_set>
#include <utility>

namespace nurbeam {
namespace {

using Entity = Handle(Standard_Transient);
using Part = Handle(StepBasic_ProductDefinition);
using Seen = std::unordered_set<const Standard_Transient*>;  // only ever looked up

// Where `part` stands in `shape`, under all locations.
void find_places(const TopoDS_Shape& part, const TopoDS_Shape& shape, std::vector<TopoDS_Shape>& places) {
  if (shape.IsPartner(part)) return places.push_back(shape);
  if (shape.ShapeType() != TopAbs_COMPOUND) return;
  for (TopoDS_Iterator below(shape); below.More(); below.Next()) find_places(part, below.Value(), places);
}

std::vector<Entity> users_of(const Entity& entity, const Interface_Graph& graph) {
  std::vector<Entity> users;
  for (Interface_EntityIterator next = graph.Sharings(entity); next.More(); next.Next())
    users.push_back(next.Value());
  return users;
}

// The shape representations that hold the entity, directly or not.
std::vector<Handle(StepShape_ShapeRepresentation)> representations_of(const Entity& start,
                                                                      const Interface_Graph& graph) {
  std::vector<Handle(StepShape_ShapeRepresentation)> found;
  Seen seen;
  std::vector<Entity> open{start};
  while (!open.empty()) {
    const Entity entity = open.back();
    open.pop_back();
    if (!seen.insert(entity.get()).second) continue;
    if (const auto shape = Handle(StepShape_ShapeRepresentation)::DownCast(entity)) {
      found.push_back(shape);
      continue;
    }
    const std::vector<Entity> users = users_of(entity, graph);
    open.insert(open.end(), users.begin(), users.end());
  }
  return found;
}

Part part_of(const StepShape_ShapeDefinitionRepresentation& definition) {
  const Handle(StepRepr_PropertyDefinition) shape = definition.Definition().PropertyDefinition();
  return shape.IsNull() ? Part() : shape->Definition().ProductDefinition();
}

// The parts that these representations, or those of the same shape, are of.
std::vector<Part> parts_of(const Entity& representation, const Interface_Graph& graph) {
  std::vector<Part> parts;
  Seen seen;
  std::vector<Entity> open{representation};
  while (!open.empty()) {
    const Entity entity = open.back();
    open.pop_back();
    if (!seen.insert(entity.get()).second) continue;
    for (const Entity& user : users_of(entity, graph)) {
      if (const auto definition = Handle(StepShape_ShapeDefinitionRepresentation)::DownCast(user)) {
        if (const Part part = part_of(*definition); !part.IsNull()) parts.push_back(part);
      } else if (user->IsKind(STANDARD_TYPE(StepRepr_RepresentationMap))) {
        return {};
      } else if (user->IsKind(STANDARD_TYPE(StepRepr_ShapeRepresentationRelationship)) &&
                 !user->IsKind(STANDARD_TYPE(StepRepr_ShapeRepresentationRelationshipWithTransformation))) {
        const auto related = Handle(StepRepr_ShapeRepresentationRelationship)::DownCast(user);
        for (const Entity& other : {Entity(related->Rep1()), Entity(related->Rep2())})
          if (!other.IsNull()) open.push_back(other);
      }
    }
  }
  return parts;
}

}  // namespace

PartPlaces::PartPlaces(const XSControl_Reader& reader, TruePlaces true_places)
    : process_(reader.WS()->TransferReader()->TransientProcess()),
      true_places_(std::move(true_places)),
      whole_(reader.OneShape()) {
  if (!whole_.IsNull()) names_ = part_names(reader, whole_);
}

TopoDS_Shape PartPlaces::shape_of(const Part& part) const {
  return TransferBRep::ShapeResult(process_, part);
}

std::vector<PartPlace> PartPlaces::of(const Part& part) const {
  const TopoDS_Shape shape = shape_of(part);
  std::vector<TopoDS_Shape> found;
  if (!whole_.IsNull() && !shape.IsNull()) find_places(shape, whole_, found);
  std::vector<PartPlace> places;
  for (const TopoDS_Shape& place : found)
    if (true_places_.concern(place.Location())) return {};
  for (const TopoDS_Shape& place : found)
    places.push_back(
        {place.Location().Transformation(), names_.IsBound(place) ? names_.Find(place) : PartName{}});
  return places;
}

std::optional<Holder> holder_of(const Entity& entity, const Interface_Graph& graph) {
  const auto representations = representations_of(entity, graph);
  if (representations.size() != 1) return std::nullopt;
  const std::vector<Part> parts = parts_of(representations[0], graph);
  if (parts.size() != 1) return std::nullopt;
  return Holder{parts[0], representations[0]->ContextOfItems()};
}

}  // namespace nurbeam
