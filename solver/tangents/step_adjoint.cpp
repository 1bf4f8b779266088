#include "solver/tangents/step_adjoint.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace nurbeam {

namespace {

using Adjoints = MotionTangents::Matrix;

// Subtracts products of a transposed matrix with columns of `to`, in `count` columns from `first` on. The
// matrix enters with its first columns, as many as `from` has rows.
template <int count>
void subtract_some(const Eigen::SparseMatrix<double>& matrix, const Adjoints& to, Eigen::Index first,
                   Adjoints& from) {
  const int *starts = matrix.outerIndexPtr(), *rows = matrix.innerIndexPtr();
  const double* values = matrix.valuePtr();
  const double* factors = to.data() + first;
  const Eigen::Index quantities = from.cols();
  double* result = from.data() + first;
  for (Eigen::Index column = 0; column < from.rows(); ++column, result += quantities) {
    double sums[count] = {};
    for (int k = starts[column]; k < starts[column + 1]; ++k)
      for (int c = 0; c < count; ++c) sums[c] += values[k] * factors[rows[k] * quantities + c];
    for (int c = 0; c < count; ++c) result[c] -= sums[c];
  }
}

void subtract_transposed(const Eigen::SparseMatrix<double>& matrix, const Adjoints& to, Adjoints& from) {
  if (from.cols() == 1) {
    from.col(0).noalias() -= matrix.leftCols(from.rows()).transpose() * to.col(0);
    return;
  }
  Eigen::Index first = 0;
  for (; first + 4 <= from.cols(); first += 4) subtract_some<4>(matrix, to, first, from);
  const Eigen::Index left = from.cols() - first;
  if (left == 3) subtract_some<3>(matrix, to, first, from);
  if (left == 2) subtract_some<2>(matrix, to, first, from);
  if (left == 1) subtract_some<1>(matrix, to, first, from);
}

}  // namespace

StepAdjoint::StepAdjoint(const GeneralizedAlpha& settings, const SecondOrderSystem& system)
    : steps_{LinearStep(settings, system), LinearStep(settings, system)} {
  Eigen::SparseMatrix<double> places = step().kkt;
  std::iota(places.valuePtr(), places.valuePtr() + places.nonZeros(), 0.0);
  transposed_ = places.transpose();
  values_.assign(transposed_.valuePtr(), transposed_.valuePtr() + transposed_.nonZeros());
}

void StepAdjoint::take(const State& before, const IntegratorHistory& history, const State& after,
                       bool repeated) {
  steps_[1 - present_].take(before, history, after, repeated);
}

void StepAdjoint::go_on() {
  constexpr double same = 1e-6;  // relative, for the round-off of times
  const double h = step().h;
  present_ = 1 - present_;
  factors_are_own_ = false;
  if (!(std::abs(step().h - h) <= same * h))
    for (Solved& solved : solved_) solved.contraction = unknown_contraction;
}

bool StepAdjoint::find_multipliers(const MotionTangents& end, Matrix& mu) {
  const auto& [alpha_m, alpha_f, beta, gamma, error] = step().parameters;
  const Eigen::Index n = end.q.rows(), m = end.lambda.rows();
  const double h = step().h, acceleration = 1 / (beta * h * h);
  Matrix by_correction(n + m, end.parameters());
  by_correction.topRows(n) = end.q + gamma * h * acceleration * end.v +
                             (1 - alpha_m) / (1 - alpha_f) * acceleration * end.a +
                             acceleration * (end.algorithmic_acceleration + end.jerk / h);
  by_correction.bottomRows(m) = end.lambda / step().scale();
  if (!solve(by_correction, mu)) return false;
  mu.topRows(n) *= step().scale();
  return true;
}

bool StepAdjoint::factorise() {
  for (std::size_t k = 0; k < values_.size(); ++k)
    transposed_.valuePtr()[k] = step().kkt.valuePtr()[values_[k]];
  for (Solved& solved : solved_) solved.contraction = unknown_contraction;
  return has_factors_ = factors_are_own_ = solver_.factorise(transposed_);
}

// Solves with the step's matrix: few right-hand sides by corrections, as a factorisation takes as long as
// some twenty solutions.
bool StepAdjoint::solve(const Matrix& rhs, Matrix& x) {
  constexpr Eigen::Index few = 2;
  if (rhs.cols() > few) {
    if (!factorise()) return false;
    solver_.solve(rhs, x);
    return true;
  }
  x.resizeLike(rhs);
  solved_.resize(static_cast<std::size_t>(rhs.cols()));
  for (Eigen::Index k = 0; k < rhs.cols(); ++k) {
    Solved& solved = solved_[static_cast<std::size_t>(k)];
    if (!solve_from_last(rhs.col(k), solved)) return false;
    x.col(k) = solved.last;
  }
  return true;
}

// Predicts a solution by a parabola through the last three, and corrects it.
bool StepAdjoint::solve_from_last(const Eigen::VectorXd& rhs, Solved& solved) {
  constexpr double tolerance = 1e-8;
  auto& [last, before, earlier, contraction] = solved;
  if (before.size() == 0) before = last;
  if (earlier.size() == 0) earlier = before;
  earlier += 3 * (last - before);
  std::swap(before, earlier);
  std::swap(last, before);
  const auto open = [&](const Eigen::VectorXd& x, Eigen::VectorXd& left) {
    left = rhs;
    left.noalias() -= step().kkt.transpose() * x;
  };
  if (has_factors_ && !factors_are_own_ && last.size() == rhs.size() &&
      correct_solution(solver_, open, tolerance, step().system->coordinate_count(), last, contraction))
    return true;
  if (!factors_are_own_ && !factorise()) return false;
  solver_.solve(rhs, last);
  return true;
}

MotionTangents StepAdjoint::start(const MotionTangents& end, const Matrix& multipliers, double by_time,
                                  const Eigen::VectorXd& later) const {
  using Start = LinearStep::Start;
  const auto& [alpha_m, alpha_f, beta, gamma, error] = step().parameters;
  const double h = step().h;
  MotionTangents start = MotionTangents::zero(end.q.rows(), end.lambda.rows(), end.parameters());
  // Derivatives by the prediction of the step.
  start.q = end.q;
  subtract_transposed(step().stiffness, multipliers, start.q);
  Matrix v = end.v;
  if (step().damped) subtract_transposed(step().damping, multipliers, v);
  const Matrix still = end.algorithmic_acceleration + end.jerk / h + h * h * beta * start.q + h * gamma * v;
  // Derivatives by the start of the step.
  const Matrix algorithmic =
      -alpha_m / (1 - alpha_m) * still - end.jerk / h + h * h * (0.5 - beta) * start.q + h * (1 - gamma) * v;
  start.v = h * start.q + v;
  start.a = alpha_f / (1 - alpha_m) * still;
  (step().start == Start::afresh ? start.a : start.algorithmic_acceleration) += algorithmic;
  if (step().start == Start::moved) start.jerk = step().lag() * (h - step().last_step) * algorithmic;
  if (later.size() == 0) return start;
  // Derivatives by the length of the step.
  start.t = end.t - later.transpose() * multipliers;
  Eigen::RowVectorXd by_length = start.t + end.last_step;
  by_length += step().q_by_length().transpose() * start.q + step().v_by_length().transpose() * v;
  by_length -= (step().end_algorithmic - step().start_algorithmic).transpose() * end.jerk / (h * h);
  if (step().start == Start::moved) {
    start.last_step = -step().lag() * step().jerk.transpose() * algorithmic;
    by_length -= start.last_step;
  }
  start.t += by_time * by_length;
  return start;
}

}  // namespace nurbeam
