#include "cad_import/step/step_units.h"

#include <STEPConstruct_UnitContext.hxx>
#include <StepBasic_ConversionBasedUnit.hxx>
#include <StepBasic_HArray1OfNamedUnit.hxx>
#include <StepBasic_MeasureWithUnit.hxx>
#include <StepBasic_NamedUnit.hxx>
#include <StepBasic_SiUnitAndPlaneAngleUnit.hxx>
#include <StepBasic_Unit.hxx>
#include <StepData_GlobalFactors.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUncertaintyAssignedContext.hxx>
#include <algorithm>
#include <cmath>

#include "cad_import/report/length_unit.h"

namespace nurbeam {
namespace {

Handle(StepRepr_GlobalUncertaintyAssignedContext) uncertainty_of(const Handle(Standard_Transient) & entity) {
  const auto context =
      Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(entity);
  return context.IsNull() ? Handle(StepRepr_GlobalUncertaintyAssignedContext)()
                          : context->GlobalUncertaintyAssignedContext();
}

bool has_plane_angle(const Handle(StepRepr_GlobalUnitAssignedContext) & units) {
  STEPConstruct_UnitContext factors;
  factors.ComputeFactors(units);
  return factors.PlaneAngleDone();
}

void add_radian(StepRepr_GlobalUnitAssignedContext& context) {
  const int count = context.Units().IsNull() ? 0 : context.NbUnits();
  const auto units = new StepBasic_HArray1OfNamedUnit(1, count + 1);
  for (int i = 1; i <= count; ++i) units->SetValue(i, context.UnitsValue(i));
  const Handle(StepBasic_SiUnitAndPlaneAngleUnit) radian = new StepBasic_SiUnitAndPlaneAngleUnit;
  radian->Init(Standard_False, StepBasic_spMilli, StepBasic_sunRadian);
  units->SetValue(count + 1, radian);
  context.SetUnits(units);
}

/// What one of this unit is, in another one; null where it is no multiple of one.
Handle(StepBasic_MeasureWithUnit) measure_of(const Handle(Standard_Transient) & unit) {
  const auto multiple = Handle(StepBasic_ConversionBasedUnit)::DownCast(unit);
  return multiple.IsNull() ? Handle(StepBasic_MeasureWithUnit)() : multiple->ConversionFactor();
}

}  // namespace

Handle(StepRepr_GlobalUnitAssignedContext) units_of(const Handle(Standard_Transient) & entity) {
  if (const auto context =
          Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(entity))
    return context->GlobalUnitAssignedContext();
  if (const auto context =
          Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext)::DownCast(entity))
    return context->GlobalUnitAssignedContext();
  return Handle(StepRepr_GlobalUnitAssignedContext)::DownCast(entity);
}

bool restate_units(const Interface_InterfaceModel& model) {
  constexpr int deepest = 100;
  bool lacks_angle = false;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(StepBasic_MeasureWithUnit) measure = measure_of(model.Value(i));
    for (int depth = 0; !measure.IsNull() && depth < deepest; ++depth) {
      const Handle(StepBasic_MeasureWithUnit) next = measure_of(measure->UnitComponent().Value());
      if (next.IsNull() || next == measure) break;
      measure->SetValueComponent(measure->ValueComponent() * next->ValueComponent());
      measure->SetUnitComponent(next->UnitComponent());
    }
  }
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(StepRepr_GlobalUnitAssignedContext) units = units_of(model.Value(i));
    if (units.IsNull() || has_plane_angle(units)) continue;
    add_radian(*units);
    lacks_angle = true;
  }
  return lacks_angle;
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

void use_units_of(const Handle(Standard_Transient) & context) {
  STEPConstruct_UnitContext factors;
  factors.ComputeFactors(units_of(context));
  StepData_GlobalFactors::Intance().InitializeFactors(factors.LengthFactor(), factors.PlaneAngleFactor(),
                                                      factors.SolidAngleFactor());
}

double resolution_of(const Interface_InterfaceModel& model) {
  double coarsest = 0;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(StepRepr_GlobalUncertaintyAssignedContext) uncertainty = uncertainty_of(model.Value(i));
    const std::optional<double> unit = length_unit_of(model.Value(i));
    if (uncertainty.IsNull() || !unit) continue;
    STEPConstruct_UnitContext factors;
    factors.ComputeFactors(units_of(model.Value(i)));
    factors.ComputeTolerance(uncertainty);
    if (!factors.HasUncertainty()) continue;
    // OpenCASCADE leaves the number in the context's own length unit.
    const double resolution = factors.Uncertainty() * *unit;
    if (std::isfinite(resolution)) coarsest = std::max(coarsest, resolution);
  }
  return coarsest;
}

}  // namespace nurbeam
