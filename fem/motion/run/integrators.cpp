#include "fem/motion/run/integrators.h"

namespace nurbeam {

namespace {

std::unique_ptr<Integrator> start(const GeneralizedAlpha& settings, const SecondOrderSystem& system,
                                  const State& from, const Integrator* before) {
  const auto* same = dynamic_cast<const GeneralizedAlphaIntegrator*>(before);
  return same ? std::make_unique<GeneralizedAlphaIntegrator>(settings, system, from, same->mass_scale())
              : std::make_unique<GeneralizedAlphaIntegrator>(settings, system, from);
}
std::unique_ptr<Integrator> start(const ExplicitRungeKutta& settings, const SecondOrderSystem& system,
                                  const State& from, const Integrator*) {
  return std::make_unique<ExplicitIntegrator>(settings, system, from);
}

std::unique_ptr<Integrator> start(const Radau& settings, const SecondOrderSystem& system, const State& from,
                                  const Integrator*) {
  return std::make_unique<RadauIntegrator>(settings, system, from);
}

}  // namespace

bool damps_fast_motions(const IntegratorSettings& settings) {
  return std::holds_alternative<GeneralizedAlpha>(settings) || std::holds_alternative<Radau>(settings);
}

std::unique_ptr<Integrator> start_integrator(const IntegratorSettings& settings,
                                             const SecondOrderSystem& system, const State& from,
                                             const Integrator* before) {
  return std::visit([&](const auto& method) { return start(method, system, from, before); }, settings);
}

}  // namespace nurbeam
