#pragma once
#include <Standard_Transient.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <optional>

namespace nurbeam {

/// The units that a representation context of a STEP file assigns; null for any other entity.
opencascade::handle<StepRepr_GlobalUnitAssignedContext> units_of(
    const opencascade::handle<Standard_Transient>& context);

/// The length unit of a representation context [m], where it has one.
std::optional<double> length_unit_of(const opencascade::handle<Standard_Transient>& context);

}  // namespace nurbeam
