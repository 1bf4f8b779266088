#include "solver/steps/linear_step.h"

namespace nurbeam {

LinearStep::LinearStep(const GeneralizedAlpha& settings, const SecondOrderSystem& of)
    : parameters(GeneralizedAlphaIntegrator::parameters(settings.rho_infinity)),
      system(&of),
      mass(of.tangent_pattern().matrix()),
      damping(mass),
      stiffness(mass),
      kkt(mass) {
  const int n = of.coordinate_count();
  const int *starts = kkt.outerIndexPtr(), *rows = kkt.innerIndexPtr();
  for (int column = 0; column < kkt.cols(); ++column)
    for (int k = starts[column]; k < starts[column + 1]; ++k)
      if (column >= n || rows[k] >= n) of_constraints_.push_back(k);
}

void LinearStep::take(const State& before, const IntegratorHistory& history, const State& after,
                      bool repeated) {
  start_velocity = before.v;
  h = after.t - before.t;
  last_step = repeated ? 0 : history.numbers[0];
  mass_scale = history.numbers[2];
  jerk = history.vectors[1];
  const auto& [alpha_m, alpha_f, beta, gamma, error] = parameters;
  start = last_step == 0                                                   ? Start::as_it_is
          : h <= GeneralizedAlphaIntegrator::largest_rescaling * last_step ? Start::moved
                                                                           : Start::afresh;
  start_algorithmic = start == Start::afresh ? before.a : history.vectors[0];
  if (start == Start::moved) start_algorithmic += lag() * (h - last_step) * jerk;
  end_algorithmic =
      ((1 - alpha_f) * after.a + alpha_f * before.a - alpha_m * start_algorithmic) / (1 - alpha_m);
  const auto values = [](auto& matrix) { return matrix.coeffs(); };
  if (has_constant_inertia_) {
    system->tangent(after, {.stiffness = 1}, stiffness);
  } else {
    system->tangents(after, {TangentWeights{.stiffness = 1}, {.damping = 1}}, {&stiffness, &damping});
    system->tangent(after, {.mass = 1}, mass);
    for (const int k : of_constraints_) damping.valuePtr()[k] = 0;
    damped = !values(damping).isZero(0);
    has_constant_inertia_ = system->has_constant_inertia();
  }
  // The matrix of mass alone is cheaper than one with all three weights, and so are sums.
  values(kkt) = ((1 - alpha_m) / (1 - alpha_f) / mass_scale) * values(mass) + scale() * values(stiffness);
  if (damped) values(kkt) += (gamma * h / mass_scale) * values(damping);
  for (const int k : of_constraints_) kkt.valuePtr()[k] = stiffness.valuePtr()[k];
}

Eigen::VectorXd LinearStep::q_by_length() const {
  const double beta = parameters.beta;
  return start_velocity + 2 * h * ((0.5 - beta) * start_algorithmic + beta * end_algorithmic);
}

Eigen::VectorXd LinearStep::v_by_length() const {
  const double gamma = parameters.gamma;
  return (1 - gamma) * start_algorithmic + gamma * end_algorithmic;
}

}  // namespace nurbeam
