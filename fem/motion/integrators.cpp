#include "fem/motion/integrators.h"

namespace nurbeam {

namespace {

std::unique_ptr<Integrator> start(const GeneralizedAlpha& settings, const SecondOrderSystem& system,
                                  const State& from) {
  return std::make_unique<GeneralizedAlphaIntegrator>(settings, system, from);
}
std::unique_ptr<Integrator> start(const Ida& settings, const SecondOrderSystem& system, const State& from) {
  return std::make_unique<IdaIntegrator>(settings, system, from);
}
std::unique_ptr<Integrator> start(const ExplicitRungeKutta& settings, const SecondOrderSystem& system,
                                  const State& from) {
  return std::make_unique<ExplicitIntegrator>(settings, system, from);
}

}  // namespace

std::unique_ptr<Integrator> start_integrator(const IntegratorSettings& settings,
                                             const SecondOrderSystem& system, const State& from) {
  return std::visit([&](const auto& method) { return start(method, system, from); }, settings);
}

Eigen::VectorXd algorithmic_acceleration(const Integrator& integrator) {
  const auto* method = dynamic_cast<const GeneralizedAlphaIntegrator*>(&integrator);
  return method ? method->algorithmic_acceleration() : Eigen::VectorXd();
}

std::unique_ptr<Integrator> repeat_step(const IntegratorSettings& settings, const SecondOrderSystem& system,
                                        const State& before, const Eigen::VectorXd& algorithmic) {
  const auto* method = std::get_if<GeneralizedAlpha>(&settings);
  if (!method) return start_integrator(settings, system, before);
  GeneralizedAlpha one_attempt = *method;
  one_attempt.max_halvings = 0;
  one_attempt.tolerance = 0;
  auto integrator = std::make_unique<GeneralizedAlphaIntegrator>(one_attempt, system, before);
  integrator->set_algorithmic_acceleration(algorithmic);
  return integrator;
}

}  // namespace nurbeam
