#pragma once
#include <memory>
#include <variant>

#include "solver/steps/explicit_integrator.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/steps/radau_integrator.h"

namespace nurbeam {

/// The methods that a motion can be integrated with.
using IntegratorSettings = std::variant<GeneralizedAlpha, ExplicitRungeKutta, Radau>;

/// Whether a method damps motions quicker than its steps, and needs accelerations without them.
bool damps_fast_motions(const IntegratorSettings& settings);

/// An integrator that goes on from a state with consistent accelerations. The system must outlive it.
/// `before`: an integrator with these settings on another mesh of the same model, whose scales are taken
/// over.
std::unique_ptr<Integrator> start_integrator(const IntegratorSettings& settings,
                                             const SecondOrderSystem& system, const State& from,
                                             const Integrator* before = nullptr);

}  // namespace nurbeam
