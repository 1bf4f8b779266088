#pragma once
#include <Eigen/Core>
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

/// What generalized-alpha keeps between steps besides the state; empty for the other methods.
Eigen::VectorXd algorithmic_acceleration(const Integrator& integrator);

/// An integrator that repeats a step from the state before it with another length, in one attempt.
/// `algorithmic` is the algorithmic_acceleration() of that moment.
std::unique_ptr<Integrator> repeat_step(const IntegratorSettings& settings, const SecondOrderSystem& system,
                                        const State& before, const Eigen::VectorXd& algorithmic);

}  // namespace nurbeam
