#include "cad_import/step/supplemental_geometry.h"

#include <StepData_StepModel.hxx>
#include <StepGeom_Curve.hxx>
#include <StepRepr_ConstructiveGeometryRepresentation.hxx>
#include <StepRepr_ConstructiveGeometryRepresentationRelationship.hxx>
#include <StepRepr_HArray1OfRepresentationItem.hxx>
#include <StepRepr_Representation.hxx>
#include <StepRepr_ShapeRepresentationRelationship.hxx>
#include <StepShape_GeometricSet.hxx>
#include <StepShape_HArray1OfGeometricSetSelect.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <set>
#include <vector>

namespace nurbeam {
namespace {

Handle(TCollection_HAsciiString) no_name() { return new TCollection_HAsciiString(""); }

std::vector<Handle(StepGeom_Curve)> curves_of(const StepRepr_Representation& representation) {
  std::vector<Handle(StepGeom_Curve)> curves;
  if (representation.Items().IsNull()) return curves;
  for (int i = 1; i <= representation.NbItems(); ++i)
    if (const auto curve = Handle(StepGeom_Curve)::DownCast(representation.ItemsValue(i)))
      curves.push_back(curve);
  return curves;
}

Handle(StepShape_GeometricSet) set_of(const std::vector<Handle(StepGeom_Curve)>& curves) {
  const auto elements = new StepShape_HArray1OfGeometricSetSelect(1, static_cast<int>(curves.size()));
  for (std::size_t i = 0; i < curves.size(); ++i)
    elements->ChangeValue(static_cast<int>(i) + 1).SetValue(curves[i]);
  const Handle(StepShape_GeometricSet) set = new StepShape_GeometricSet;
  set->Init(no_name(), elements);
  return set;
}

void join(const Handle(StepRepr_Representation) & part, const StepRepr_Representation& supplement,
          StepData_StepModel& model) {
  const std::vector<Handle(StepGeom_Curve)> curves = curves_of(supplement);
  if (curves.empty() || supplement.ContextOfItems().IsNull()) return;
  const Handle(StepShape_GeometricSet) set = set_of(curves);
  const auto items = new StepRepr_HArray1OfRepresentationItem(1, 1);
  items->SetValue(1, set);
  const Handle(StepShape_ShapeRepresentation) shape = new StepShape_ShapeRepresentation;
  shape->Init(no_name(), items, supplement.ContextOfItems());
  const Handle(StepRepr_ShapeRepresentationRelationship) relation =
      new StepRepr_ShapeRepresentationRelationship;
  relation->Init(no_name(), no_name(), part, shape);
  for (const Handle(Standard_Transient) & added :
       {Handle(Standard_Transient)(set), Handle(Standard_Transient)(shape),
        Handle(Standard_Transient)(relation)}) {
    model.AddEntity(added);
    model.SetIdentLabel(added, 0);  // of none in the file
  }
}

}  // namespace

void join_supplemental_geometry(STEPControl_Reader& reader) {
  StepData_StepModel& model = *reader.StepModel();
  const int count = model.NbEntities();
  std::set<const Standard_Transient*> joined;
  for (int i = 1; i <= count; ++i) {
    const auto relation =
        Handle(StepRepr_ConstructiveGeometryRepresentationRelationship)::DownCast(model.Value(i));
    if (relation.IsNull() || relation->Rep1().IsNull() || relation->Rep2().IsNull()) continue;
    const auto first = Handle(StepRepr_ConstructiveGeometryRepresentation)::DownCast(relation->Rep1());
    const auto second = Handle(StepRepr_ConstructiveGeometryRepresentation)::DownCast(relation->Rep2());
    if (first.IsNull() == second.IsNull()) continue;
    const auto& supplement = first.IsNull() ? second : first;
    if (joined.insert(supplement.get()).second)
      join(first.IsNull() ? relation->Rep1() : relation->Rep2(), *supplement, model);
  }
  if (model.NbEntities() == count) return;
  reader.WS()->ComputeGraph(/*enforce=*/Standard_True);
  reader.WS()->InitTransferReader(0);  // else it goes by the graph before
}

}  // namespace nurbeam
