#include "solver/step_tangent.h"

#include <numeric>

#include "solver/every_processor.h"

namespace nurbeam {

namespace {

// Numbers of as many parameters, side by side.
struct Eight {
  using Side = double __attribute__((vector_size(8 * sizeof(double)), aligned(sizeof(double)), may_alias));
};
struct Four {
  using Side = double __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));
};
struct One {
  using Side = double;
};

}  // namespace

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
      kkt_(mass_),
      row_starts_(static_cast<std::size_t>(mass_.rows()) + 1, 0) {
  const int n = system.coordinate_count();
  const int *starts = kkt_.outerIndexPtr(), *rows = kkt_.innerIndexPtr();
  for (int k = 0; k < starts[n]; ++k) ++row_starts_[rows[k] + 1];
  std::partial_sum(row_starts_.begin(), row_starts_.end(), row_starts_.begin());
  entries_.resize(static_cast<std::size_t>(starts[n]));
  std::vector<int> next = row_starts_;
  for (int column = 0; column < kkt_.cols(); ++column)
    for (int k = starts[column]; k < starts[column + 1]; ++k) {
      if (column < n) entries_[next[rows[k]]++] = {column, k};
      if (column >= n || rows[k] >= n) of_constraints_.push_back(k);
    }
}

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
  for (const int k : of_constraints_) mass_.valuePtr()[k] = damping_.valuePtr()[k] = 0;
  const auto values = [](auto& matrix) { return matrix.coeffs(); };
  damped_ = !values(damping_).isZero(0);
  values(kkt_) = ((1 - alpha_m) / (1 - alpha_f) / mass_scale_) * values(mass_) +
                 (gamma * h_ / mass_scale_) * values(damping_) +
                 (beta * h_ * h_ / mass_scale_) * values(stiffness_);
  for (const int k : of_constraints_) kkt_.valuePtr()[k] = stiffness_.valuePtr()[k];
  return solver_.factorise(kkt_);
}

MotionTangents StepTangent::end(const MotionTangents& start, const Eigen::RowVectorXd& step,
                                const Matrix& dynamics, const Matrix& constraints) const {
  const auto& [alpha_m, alpha_f, beta, gamma, error] = parameters_;
  const Eigen::Index n = start.q.rows(), m = start.lambda.rows();
  const bool other_length = !step.isZero(0);
  Matrix moved;
  if (start_ == Start::moved) {
    moved = start.algorithmic_acceleration + (alpha_m - alpha_f) * (h_ - last_step_) * start.jerk;
    moved.noalias() += (alpha_m - alpha_f) * jerk_ * (step - start.last_step);
  }
  const Matrix& alg = start_ == Start::moved    ? moved
                      : start_ == Start::afresh ? start.a
                                                : start.algorithmic_acceleration;

  // With the algorithmic acceleration at the end as it is.
  MotionTangents end;
  end.t = start.t + step;
  end.q = start.q + h_ * start.v + h_ * h_ * (0.5 - beta) * alg;
  end.v = start.v + h_ * (1 - gamma) * alg;
  end.a = alpha_m / (1 - alpha_f) * alg - alpha_f / (1 - alpha_f) * start.a;
  if (other_length) {
    end.q.noalias() +=
        (before_.v + 2 * h_ * ((0.5 - beta) * start_algorithmic_ + beta * end_algorithmic_)) * step;
    end.v.noalias() += ((1 - gamma) * start_algorithmic_ + gamma * end_algorithmic_) * step;
  }

  // The correction of q for which the residual stays zero, and what follows it.
  Matrix rhs(n + m, start.parameters()), x;
  rhs << -dynamics, -constraints;
  subtract_residual(end, rhs);
  rhs.topRows(n) *= beta * h_ * h_ / mass_scale_;
  solver_.solve(rhs, x);
  const auto dq = x.topRows(n);
  const double acceleration = 1 / (beta * h_ * h_);
  end.algorithmic_acceleration = acceleration * dq;
  end.q += dq;
  end.v += gamma * h_ * acceleration * dq;
  end.a += (1 - alpha_m) / (1 - alpha_f) * acceleration * dq;
  end.lambda = mass_scale_ * acceleration * x.bottomRows(m);
  end.jerk = acceleration / h_ * dq - 1 / h_ * alg;
  if (other_length) end.jerk.noalias() -= (end_algorithmic_ - start_algorithmic_) / (h_ * h_) * step;
  end.last_step = step;
  return end;
}

// M a + D v + K q with the rows of constraints, G q, of as many parameters as there are lanes.
template <class Lanes>
NURBEAM_WITHIN void StepTangent::subtract_products(const MotionTangents& end, Eigen::Index first,
                                                   Matrix& rhs) const {
  using Side = typename Lanes::Side;
  const Eigen::Index stride = rhs.cols();
  const auto rows = [&](const double* columns) { return columns + first; };
  const double *q = rows(end.q.data()), *v = rows(end.v.data()), *a = rows(end.a.data());
  const double *K = stiffness_.valuePtr(), *D = damping_.valuePtr(), *M = mass_.valuePtr();
  double* result = rhs.data() + first;
  for (std::size_t row = 0; row + 1 < row_starts_.size(); ++row) {
    Side sum = {};
    for (int k = row_starts_[row]; k < row_starts_[row + 1]; ++k) {
      const auto [column, value] = entries_[k];
      sum += K[value] * *reinterpret_cast<const Side*>(q + column * stride) +
             M[value] * *reinterpret_cast<const Side*>(a + column * stride);
      if (damped_) sum += D[value] * *reinterpret_cast<const Side*>(v + column * stride);
    }
    *reinterpret_cast<Side*>(result + static_cast<Eigen::Index>(row) * stride) -= sum;
  }
}

NURBEAM_FOR_EVERY_PROCESSOR void StepTangent::subtract_residual(const MotionTangents& end,
                                                                Matrix& rhs) const {
  const Eigen::Index parameters = rhs.cols();
  Eigen::Index first = 0;
  for (; first + 8 <= parameters; first += 8) subtract_products<Eight>(end, first, rhs);
  for (; first + 4 <= parameters; first += 4) subtract_products<Four>(end, first, rhs);
  for (; first < parameters; ++first) subtract_products<One>(end, first, rhs);
}

}  // namespace nurbeam
