#pragma once
#include <Interface_InterfaceModel.hxx>
#include <Standard_Transient.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <optional>
#include <set>

namespace nurbeam {

/// The units that a representation context of a STEP file assigns; null for any other entity.
opencascade::handle<StepRepr_GlobalUnitAssignedContext> units_of(
    const opencascade::handle<Standard_Transient>& context);

/// Says units that are multiples of such ones, a foot of 12 inches, in units of the SI: OpenCASCADE knows no
/// others. Contexts without a unit of plane angles get the radian, where OpenCASCADE takes degrees; whether
/// there are any.
bool restate_units(const Interface_InterfaceModel& model);

/// The length unit of a representation context [m], where it has one.
std::optional<double> length_unit_of(const opencascade::handle<Standard_Transient>& context);

/// The length units of all contexts of a file [m].
std::set<double> length_units_of(const Interface_InterfaceModel& model);

/// From now on OpenCASCADE takes the numbers of geometry for those of this context.
void use_units_of(const opencascade::handle<Standard_Transient>& context);

/// The coarsest of the accuracies that its contexts declare [m]; 0 where none does.
double resolution_of(const Interface_InterfaceModel& model);

}  // namespace nurbeam
