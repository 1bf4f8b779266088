#pragma once
#include <memory>
#include <variant>

#include "solver/explicit_integrator.h"
#include "solver/generalized_alpha.h"
#include "solver/ida_integrator.h"

namespace nurbeam {

/// The methods that a motion can be integrated with.
using IntegratorSettings = std::variant<GeneralizedAlpha, Ida, ExplicitRungeKutta>;

/// An integrator that goes on from a state with consistent accelerations. The system must outlive it.
std::unique_ptr<Integrator> start_integrator(const IntegratorSettings& settings,
                                             const SecondOrderSystem& system, const State& from);

}  // namespace nurbeam
