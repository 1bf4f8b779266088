#include "cad_import/step/set_items.h"

#include <StepGeom_CartesianPoint.hxx>
#include <StepRepr_HArray1OfRepresentationItem.hxx>
#include <StepRepr_Representation.hxx>
#include <StepShape_GeometricSet.hxx>
#include <StepShape_GeometricSetSelect.hxx>
#include <StepShape_HArray1OfGeometricSetSelect.hxx>
#include <TCollection_HAsciiString.hxx>

namespace nurbeam {

void replace_items(const Interface_InterfaceModel& model,
                   const std::function<bool(const opencascade::handle<Standard_Transient>&)>& is_replaced) {
  const Handle(StepGeom_CartesianPoint) point = new StepGeom_CartesianPoint;
  point->Init3D(new TCollection_HAsciiString(""), 0, 0, 0);
  StepShape_GeometricSetSelect element;
  element.SetValue(point);
  for (int i = 1; i <= model.NbEntities(); ++i) {
    if (const auto set = Handle(StepShape_GeometricSet)::DownCast(model.Value(i));
        !set.IsNull() && !set->Elements().IsNull())
      for (StepShape_GeometricSetSelect& kept : set->Elements()->ChangeArray1())
        if (!kept.Value().IsNull() && is_replaced(kept.Value())) kept = element;
    if (const auto representation = Handle(StepRepr_Representation)::DownCast(model.Value(i));
        !representation.IsNull() && !representation->Items().IsNull())
      for (Handle(StepRepr_RepresentationItem) & item : representation->Items()->ChangeArray1())
        if (!item.IsNull() && is_replaced(item)) item = point;
  }
}

}  // namespace nurbeam
