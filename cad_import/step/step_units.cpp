#include "cad_import/step/step_units.h"

#include <STEPConstruct_UnitContext.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>

#include "cad_import/report/length_unit.h"

namespace nurbeam {

Handle(StepRepr_GlobalUnitAssignedContext) units_of(const Handle(Standard_Transient) & entity) {
  if (const auto context =
          Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(entity))
    return context->GlobalUnitAssignedContext();
  if (const auto context =
          Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext)::DownCast(entity))
    return context->GlobalUnitAssignedContext();
  return Handle(StepRepr_GlobalUnitAssignedContext)::DownCast(entity);
}

std::optional<double> length_unit_of(const Handle(Standard_Transient) & context) {
  const Handle(StepRepr_GlobalUnitAssignedContext) units = units_of(context);
  if (units.IsNull()) return std::nullopt;
  STEPConstruct_UnitContext factors;
  factors.ComputeFactors(units);
  if (!factors.LengthDone()) return std::nullopt;
  return factors.LengthFactor() * metres_per_millimetre;
}

std::set<double> length_units_of(const Interface_InterfaceModel& model) {
  std::set<double> units;
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (const auto unit = length_unit_of(model.Value(i))) units.insert(*unit);
  return units;
}

}  // namespace nurbeam
