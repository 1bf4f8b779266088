#include "cad_import/program/part_names.h"

#include <IGESBasic_Group.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <optional>
#include <unordered_map>

#include "cad_import/program/entity_origins.h"

namespace nurbeam {
namespace {

/// What the file calls the shapes that were made of its products, occurrences and groups.
struct ShapeNames {
  NCollection_DataMap<TopoDS_Shape, std::string, TopTools_ShapeMapHasher> placed;  // occurrences
  std::unordered_map<const TopoDS_TShape*, std::string> shared;                    // only ever looked up

  /// "" of a part without a name, nothing of what is no part.
  std::optional<std::string> of(const TopoDS_Shape& shape) const {
    if (placed.IsBound(shape)) return placed.Find(shape);
    const auto known = shared.find(shape.TShape().get());
    return known == shared.end() ? std::nullopt : std::optional(known->second);
  }
};

ShapeNames shape_names(const XSControl_Reader& reader) {
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  ShapeNames names;
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const Handle(Standard_Transient) entity = process->Mapped(i);
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
    if (shape.IsNull()) continue;
    if (const auto used = Handle(StepRepr_NextAssemblyUsageOccurrence)::DownCast(entity)) {
      if (const std::string name = trimmed_text(used->Name()); !name.empty()) names.placed.Bind(shape, name);
    } else if (const auto definition = Handle(StepBasic_ProductDefinition)::DownCast(entity)) {
      names.shared.emplace(shape.TShape().get(), product_name(definition));
    } else if (entity->IsKind(STANDARD_TYPE(IGESBasic_Group))) {
      names.shared.emplace(shape.TShape().get(), entity_name(entity));
    }
  }
  return names;
}

void bind_all(const TopoDS_Shape& shape, const PartName& name, PartNames& parts) {
  for (const TopAbs_ShapeEnum kind : {TopAbs_EDGE, TopAbs_FACE}) {
    TopTools_IndexedMapOfShape found;
    TopExp::MapShapes(shape, kind, found);
    for (int i = 1; i <= found.Extent(); ++i) parts.Bind(found(i), name);
  }
}

// `own`: the shape as its assembly holds it; `placed`: the same under all locations above.
void name_below(const TopoDS_Shape& own, const TopoDS_Shape& placed, PartName name, const ShapeNames& names,
                PartNames& parts) {
  if (const auto known = names.of(own)) name = {*known, name.path + (name.path.empty() ? "" : "/") + *known};
  parts.Bind(placed, name);
  if (placed.ShapeType() != TopAbs_COMPOUND) {
    if (!name.path.empty()) bind_all(placed, name, parts);
    return;
  }
  TopoDS_Iterator below(own, /*cumOri=*/Standard_False, /*cumLoc=*/Standard_False), there(placed);
  for (; below.More() && there.More(); below.Next(), there.Next())
    name_below(below.Value(), there.Value(), name, names, parts);
}

}  // namespace

std::string product_name(const Handle(StepBasic_ProductDefinition) & definition) {
  if (definition.IsNull() || definition->Formation().IsNull() ||
      definition->Formation()->OfProduct().IsNull())
    return "";
  const Handle(StepBasic_Product) product = definition->Formation()->OfProduct();
  const std::string name = trimmed_text(product->Name());
  return name.empty() ? trimmed_text(product->Id()) : name;
}

PartNames part_names(const XSControl_Reader& reader, const TopoDS_Shape& root) {
  PartNames parts;
  name_below(root, root, {}, shape_names(reader), parts);
  return parts;
}

}  // namespace nurbeam
