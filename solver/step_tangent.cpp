#include "solver/step_tangent.h"

namespace nurbeam {

MotionTangent MotionTangent::zero(int coordinates, int constraints) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(coordinates);
  return {
      {.t = 0, .q = none, .v = none, .a = none, .lambda = Eigen::VectorXd::Zero(constraints)}, none, none, 0};
}

StepTangent::StepTangent(const GeneralizedAlpha& settings, const SecondOrderSystem& system,
                         const State& before, const IntegratorHistory& history, const State& after,
                         bool repeated)
    : parameters_(GeneralizedAlphaIntegrator::parameters(settings.rho_infinity)),
      before_(before),
      h_(after.t - before.t),
      last_step_(repeated ? 0 : history.numbers[0]),
      mass_scale_(history.numbers[2]),
      jerk_(history.vectors[1]) {
  const auto& [alpha_m, alpha_f, beta, gamma, error] = parameters_;
  start_ = last_step_ == 0                                                    ? Start::as_it_is
           : h_ <= GeneralizedAlphaIntegrator::largest_rescaling * last_step_ ? Start::moved
                                                                              : Start::afresh;
  start_algorithmic_ = start_ == Start::afresh ? before.a : history.vectors[0];
  if (start_ == Start::moved) start_algorithmic_ += (alpha_m - alpha_f) * (h_ - last_step_) * jerk_;
  end_algorithmic_ =
      ((1 - alpha_f) * after.a + alpha_f * before.a - alpha_m * start_algorithmic_) / (1 - alpha_m);
  mass_ = damping_ = stiffness_ = system.tangent_pattern();
  system.tangent(after, {.mass = 1}, mass_);
  system.tangent(after, {.damping = 1}, damping_);
  system.tangent(after, {.stiffness = 1}, stiffness_);
  Eigen::SparseMatrix<double> kkt = stiffness_;
  for (int column = 0; column < system.coordinate_count(); ++column)
    for (int k = kkt.outerIndexPtr()[column]; k < kkt.outerIndexPtr()[column + 1]; ++k)
      if (kkt.innerIndexPtr()[k] < system.coordinate_count())
        kkt.valuePtr()[k] =
            ((1 - alpha_m) / (1 - alpha_f) * mass_.valuePtr()[k] + gamma * h_ * damping_.valuePtr()[k] +
             beta * h_ * h_ * stiffness_.valuePtr()[k]) /
            mass_scale_;
  regular_ = solver_.factorise(kkt);
}

MotionTangent StepTangent::end(const MotionTangent& start, double step, const Eigen::VectorXd& dynamics,
                               const Eigen::VectorXd& constraints) const {
  const auto& [alpha_m, alpha_f, beta, gamma, error] = parameters_;
  const State& from = start.state;
  const Eigen::Index n = from.q.size(), m = from.lambda.size();
  Eigen::VectorXd alg = start_ == Start::afresh ? from.a : start.algorithmic_acceleration;
  if (start_ == Start::moved)
    alg += (alpha_m - alpha_f) * ((step - start.last_step) * jerk_ + (h_ - last_step_) * start.jerk);

  // With the algorithmic acceleration at the end as it is.
  MotionTangent end;
  end.state.t = from.t + step;
  end.state.q = from.q + h_ * from.v + h_ * h_ * (0.5 - beta) * alg +
                step * (before_.v + 2 * h_ * ((0.5 - beta) * start_algorithmic_ + beta * end_algorithmic_));
  end.state.v =
      from.v + h_ * (1 - gamma) * alg + step * ((1 - gamma) * start_algorithmic_ + gamma * end_algorithmic_);
  end.state.a = (alpha_m * alg - alpha_f * from.a) / (1 - alpha_f);

  // The correction of q for which the residual stays zero, and what follows it.
  const auto padded = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(n + m);
    all.head(n) = x;
    return all;
  };
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n + m);
  rhs -= stiffness_ * padded(end.state.q);
  rhs.head(n) -= (damping_ * padded(end.state.v) + mass_ * padded(end.state.a)).head(n) + dynamics;
  rhs.tail(m) -= constraints;
  rhs.head(n) *= beta * h_ * h_ / mass_scale_;
  const Eigen::VectorXd x = solver_.solve(rhs);
  const auto dq = x.head(n);
  const double acceleration = 1 / (beta * h_ * h_);
  end.algorithmic_acceleration = acceleration * dq;
  end.state.q += dq;
  end.state.v += gamma * h_ * end.algorithmic_acceleration;
  end.state.a += (1 - alpha_m) / (1 - alpha_f) * end.algorithmic_acceleration;
  end.state.lambda = mass_scale_ * acceleration * x.tail(m);
  end.jerk =
      (end.algorithmic_acceleration - alg) / h_ - step / (h_ * h_) * (end_algorithmic_ - start_algorithmic_);
  end.last_step = step;
  return end;
}

}  // namespace nurbeam
