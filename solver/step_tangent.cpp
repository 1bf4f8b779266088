#include "solver/step_tangent.h"

namespace nurbeam {

MotionTangents MotionTangents::zero(Eigen::Index coordinates, Eigen::Index constraints,
                                    Eigen::Index parameters) {
  const Matrix none = Matrix::Zero(coordinates, parameters);
  const Eigen::RowVectorXd zeros = Eigen::RowVectorXd::Zero(parameters);
  return {zeros, zeros, none, none, none, Matrix::Zero(constraints, parameters), none, none};
}

State MotionTangents::of(Eigen::Index parameter) const {
  return {.t = t[parameter],
          .q = q.col(parameter),
          .v = v.col(parameter),
          .a = a.col(parameter),
          .lambda = lambda.col(parameter)};
}

void MotionTangents::move(Eigen::Index parameter, const State& tangent, double part) {
  t[parameter] += part * tangent.t;
  q.col(parameter) += part * tangent.q;
  v.col(parameter) += part * tangent.v;
  a.col(parameter) += part * tangent.a;
  lambda.col(parameter) += part * tangent.lambda;
}

void MotionTangents::start_afresh(Eigen::Index parameter, const State& tangent) {
  t[parameter] = tangent.t;
  last_step[parameter] = 0;
  q.col(parameter) = tangent.q;
  v.col(parameter) = tangent.v;
  a.col(parameter) = algorithmic_acceleration.col(parameter) = tangent.a;
  lambda.col(parameter) = tangent.lambda;
  jerk.col(parameter).setZero();
}

StepTangent::StepTangent(const GeneralizedAlpha& settings, const SecondOrderSystem& system)
    : parameters_(GeneralizedAlphaIntegrator::parameters(settings.rho_infinity)),
      system_(&system),
      mass_(system.tangent_pattern()),
      damping_(mass_),
      stiffness_(mass_),
      kkt_(mass_) {}

bool StepTangent::take(const State& before, const IntegratorHistory& history, const State& after,
                       bool repeated) {
  before_ = before;
  h_ = after.t - before.t;
  last_step_ = repeated ? 0 : history.numbers[0];
  mass_scale_ = history.numbers[2];
  jerk_ = history.vectors[1];
  const auto& [alpha_m, alpha_f, beta, gamma, error] = parameters_;
  start_ = last_step_ == 0                                                    ? Start::as_it_is
           : h_ <= GeneralizedAlphaIntegrator::largest_rescaling * last_step_ ? Start::moved
                                                                              : Start::afresh;
  start_algorithmic_ = start_ == Start::afresh ? before.a : history.vectors[0];
  if (start_ == Start::moved) start_algorithmic_ += (alpha_m - alpha_f) * (h_ - last_step_) * jerk_;
  end_algorithmic_ =
      ((1 - alpha_f) * after.a + alpha_f * before.a - alpha_m * start_algorithmic_) / (1 - alpha_m);
  system_->tangent(after, {.mass = 1}, mass_);
  system_->tangent(after, {.damping = 1}, damping_);
  system_->tangent(after, {.stiffness = 1}, stiffness_);
  const int n = system_->coordinate_count();
  for (int column = 0; column < kkt_.cols(); ++column)
    for (int k = kkt_.outerIndexPtr()[column]; k < kkt_.outerIndexPtr()[column + 1]; ++k)
      kkt_.valuePtr()[k] =
          column < n && kkt_.innerIndexPtr()[k] < n
              ? ((1 - alpha_m) / (1 - alpha_f) * mass_.valuePtr()[k] + gamma * h_ * damping_.valuePtr()[k] +
                 beta * h_ * h_ * stiffness_.valuePtr()[k]) /
                    mass_scale_
              : stiffness_.valuePtr()[k];
  return solver_.factorise(kkt_);
}

MotionTangents StepTangent::end(const MotionTangents& start, const Eigen::RowVectorXd& step,
                                const Matrix& dynamics, const Matrix& constraints) const {
  const auto& [alpha_m, alpha_f, beta, gamma, error] = parameters_;
  const Eigen::Index n = start.q.rows(), m = start.lambda.rows(), parameters = start.parameters();
  Matrix alg = start_ == Start::afresh ? start.a : start.algorithmic_acceleration;
  if (start_ == Start::moved) {
    alg += (alpha_m - alpha_f) * (h_ - last_step_) * start.jerk;
    alg.noalias() += (alpha_m - alpha_f) * jerk_ * (step - start.last_step);
  }

  // With the algorithmic acceleration at the end as it is.
  MotionTangents end = MotionTangents::zero(n, m, parameters);
  end.t = start.t + step;
  end.q = start.q + h_ * start.v + h_ * h_ * (0.5 - beta) * alg;
  end.v = start.v + h_ * (1 - gamma) * alg;
  end.a = (alpha_m * alg - alpha_f * start.a) / (1 - alpha_f);
  const bool other_length = !step.isZero(0);
  if (other_length) {
    end.q.noalias() +=
        (before_.v + 2 * h_ * ((0.5 - beta) * start_algorithmic_ + beta * end_algorithmic_)) * step;
    end.v.noalias() += ((1 - gamma) * start_algorithmic_ + gamma * end_algorithmic_) * step;
  }

  // The correction of q for which the residual stays zero, and what follows it.
  Matrix rhs = -residual_of(end);
  rhs.topRows(n) -= dynamics;
  rhs.bottomRows(m) -= constraints;
  rhs.topRows(n) *= beta * h_ * h_ / mass_scale_;
  const Matrix x = solve(rhs);
  const auto dq = x.topRows(n);
  const double acceleration = 1 / (beta * h_ * h_);
  end.algorithmic_acceleration = acceleration * dq;
  end.q += dq;
  end.v += gamma * h_ * end.algorithmic_acceleration;
  end.a += (1 - alpha_m) / (1 - alpha_f) * end.algorithmic_acceleration;
  end.lambda = mass_scale_ * acceleration * x.bottomRows(m);
  end.jerk = (end.algorithmic_acceleration - alg) / h_;
  if (other_length) end.jerk.noalias() -= (end_algorithmic_ - start_algorithmic_) / (h_ * h_) * step;
  end.last_step = step;
  return end;
}

// M a + D v + K q with the rows of constraints, G q, of all parameters.
StepTangent::Matrix StepTangent::residual_of(const MotionTangents& end) const {
  const Eigen::Index n = end.q.rows();
  Matrix sum = Matrix::Zero(n + end.lambda.rows(), end.parameters());
  for (Eigen::Index column = 0; column < n; ++column)
    for (int k = stiffness_.outerIndexPtr()[column]; k < stiffness_.outerIndexPtr()[column + 1]; ++k) {
      const int row = stiffness_.innerIndexPtr()[k];
      sum.row(row) += stiffness_.valuePtr()[k] * end.q.row(column);
      if (row >= n) continue;
      if (const double d = damping_.valuePtr()[k]; d != 0) sum.row(row) += d * end.v.row(column);
      if (const double m = mass_.valuePtr()[k]; m != 0) sum.row(row) += m * end.a.row(column);
    }
  return sum;
}

StepTangent::Matrix StepTangent::solve(const Matrix& rhs) const {
  Matrix x(rhs.rows(), rhs.cols());
  Eigen::VectorXd right, left;
  for (Eigen::Index parameter = 0; parameter < rhs.cols(); ++parameter) {
    right = rhs.col(parameter);
    solver_.solve(right, left);
    x.col(parameter) = left;
  }
  return x;
}

}  // namespace nurbeam
