#include "cad_import/step/between_placements.h"

#include <StepGeom_Axis2Placement3d.hxx>
#include <StepRepr_HArray1OfRepresentationItem.hxx>
#include <StepRepr_ItemDefinedTransformation.hxx>
#include <StepRepr_Representation.hxx>
#include <StepRepr_RepresentationContext.hxx>
#include <StepRepr_RepresentationMap.hxx>
#include <utility>

#include "cad_import/step/axis_placement.h"
#include "cad_import/step/step_units.h"

namespace nurbeam {
namespace {

using Placement = Handle(StepGeom_Axis2Placement3d);
using Representation = Handle(StepRepr_Representation);

/// The one that OpenCASCADE is to be given in the place of `target`; null where that will do. `unit`: of the
/// origin's numbers, over that of the target's.
Placement target_as_read(const StepGeom_Axis2Placement3d& origin, double unit,
                         const StepGeom_Axis2Placement3d& target) {
  constexpr double round_off = 1e-13;
  Eigen::Affine3d from = place_of(origin);
  from.translation() *= unit;
  const Eigen::Affine3d to = place_of(target), back = from.inverse();
  const Eigen::Affine3d meant = to * back, taken = back * to;
  const double size = from.translation().norm() + to.translation().norm();
  if ((meant.linear() - taken.linear()).norm() <= round_off &&
      (meant.translation() - taken.translation()).norm() <= round_off * size)
    return {};
  return axis_placement(from * meant);
}

bool holds(const Representation& representation, const Handle(StepRepr_RepresentationItem) & item) {
  for (int i = 1; i <= representation->NbItems(); ++i)
    if (representation->ItemsValue(i) == item) return true;
  return false;
}

/// OpenCASCADE looks for placements there.
void add_item(StepRepr_Representation& representation, const Handle(StepRepr_RepresentationItem) & item) {
  const int count = representation.NbItems();
  const Handle(StepRepr_HArray1OfRepresentationItem) items =
      new StepRepr_HArray1OfRepresentationItem(1, count + 1);
  for (int i = 1; i <= count; ++i) items->SetValue(i, representation.ItemsValue(i));
  items->SetValue(count + 1, item);
  representation.SetItems(items);
}

/// The ratio of the length units of their contexts.
double unit_ratio(const Representation& from, const Representation& to) {
  const auto a = length_unit_of(from->ContextOfItems()), b = length_unit_of(to->ContextOfItems());
  return a && b ? *a / *b : 1;
}

}  // namespace

void restate_between_axes(StepRepr_RepresentationRelationshipWithTransformation& relation) {
  const Handle(StepRepr_ItemDefinedTransformation) given =
      Handle(StepRepr_ItemDefinedTransformation)::DownCast(relation.TransformationOperator().Value());
  const Representation from = relation.Rep1(), to = relation.Rep2();
  if (given.IsNull() || from.IsNull() || to.IsNull()) return;
  auto origin = Placement::DownCast(given->TransformItem1()),
       target = Placement::DownCast(given->TransformItem2());
  if (origin.IsNull() || target.IsNull()) return;
  // Some exporters write them in the other order; OpenCASCADE sees it so too.
  const bool as_meant = holds(from, origin) || holds(to, target);
  const bool swapped = !as_meant && holds(from, target) && holds(to, origin);
  if (swapped) std::swap(origin, target);
  const Placement as_read = target_as_read(*origin, unit_ratio(from, to), *target);
  if (as_read.IsNull()) return;
  if (holds(to, target)) add_item(*to, as_read);
  const Handle(StepRepr_ItemDefinedTransformation) restated = new StepRepr_ItemDefinedTransformation;
  restated->Init(given->Name(), given->Description(), swapped ? as_read : origin, swapped ? origin : as_read);
  StepRepr_Transformation transformation;
  transformation.SetValue(restated);
  relation.SetTransformationOperator(transformation);
}

void restate_between_axes(StepRepr_MappedItem& item) {
  const auto origin = Placement::DownCast(item.MappingSource()->MappingOrigin()),
             target = Placement::DownCast(item.MappingTarget());
  if (const Placement as_read = target_as_read(*origin, 1, *target); !as_read.IsNull())
    item.SetMappingTarget(as_read);
}

}  // namespace nurbeam
