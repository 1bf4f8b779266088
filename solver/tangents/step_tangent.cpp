#include "solver/tangents/step_tangent.h"

#include <numeric>

#include "solver/algebra/every_processor.h"

namespace nurbeam {

namespace {

// Lanes: numbers of four parameters, or of one, side by side.
struct Four {
  using Side = double __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));
};
struct One {
  using Side = double;
};
using Matrix = MotionTangents::Matrix;

template <class Lanes>
NURBEAM_WITHIN typename Lanes::Side& side(double* at) {
  return *reinterpret_cast<typename Lanes::Side*>(at);
}
template <class Lanes>
NURBEAM_WITHIN const typename Lanes::Side& side(const double* at) {
  return *reinterpret_cast<const typename Lanes::Side*>(at);
}
template <class Lanes>
constexpr Eigen::Index width = sizeof(typename Lanes::Side) / sizeof(double);

// Factors of the start of a step in its predicted end.
struct Prediction {
  double h, a_of_start, a_of_before, q_of_start, q_of_end, v_of_start, v_of_end;

  template <class Lanes>
  NURBEAM_WITHIN void find(const MotionTangents& start, const Matrix& algorithmic, MotionTangents& end,
                           Eigen::Index first, Eigen::Index last) const {
    using Side = typename Lanes::Side;
    const double *q = start.q.data(), *v = start.v.data(), *a = start.a.data(), *alg = algorithmic.data();
    double *end_q = end.q.data(), *end_v = end.v.data(), *end_alg = end.algorithmic_acceleration.data();
    for (Eigen::Index i = first; i < last; i += width<Lanes>) {
      const Side speed = side<Lanes>(v + i), of_start = side<Lanes>(alg + i);
      const Side still = a_of_start * of_start + a_of_before * side<Lanes>(a + i);
      side<Lanes>(end_alg + i) = still;
      side<Lanes>(end_q + i) = side<Lanes>(q + i) + h * speed + q_of_start * of_start + q_of_end * still;
      side<Lanes>(end_v + i) = speed + v_of_start * of_start + v_of_end * still;
    }
  }
};

// Factors of a correction of q in the quantities that follow it.
struct Correction {
  double acceleration, v, a, per_step;

  template <class Lanes>
  NURBEAM_WITHIN void make(const Matrix& x, const Matrix& algorithmic, MotionTangents& end,
                           Eigen::Index first, Eigen::Index last) const {
    using Side = typename Lanes::Side;
    const double *all = x.data(), *alg = algorithmic.data();
    double *end_q = end.q.data(), *end_v = end.v.data(), *end_a = end.a.data(),
           *end_alg = end.algorithmic_acceleration.data(), *jerk = end.jerk.data();
    for (Eigen::Index i = first; i < last; i += width<Lanes>) {
      const Side dq = side<Lanes>(all + i), corrected = side<Lanes>(end_alg + i) + acceleration * dq;
      side<Lanes>(end_q + i) += dq;
      side<Lanes>(end_v + i) += v * dq;
      side<Lanes>(end_a + i) = a * dq;
      side<Lanes>(end_alg + i) = corrected;
      side<Lanes>(jerk + i) = per_step * (corrected - side<Lanes>(alg + i));
    }
  }
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

void MotionTangents::start_afresh() {
  last_step.setZero();
  algorithmic_acceleration = a;
  jerk.setZero();
}

StepTangent::StepTangent(const GeneralizedAlpha& settings, const SecondOrderSystem& system)
    : step_(settings, system), row_starts_(static_cast<std::size_t>(step_.kkt.rows()) + 1, 0) {
  const int n = system.coordinate_count();
  const int *starts = step_.kkt.outerIndexPtr(), *rows = step_.kkt.innerIndexPtr();
  for (int k = 0; k < starts[n]; ++k) ++row_starts_[rows[k] + 1];
  std::partial_sum(row_starts_.begin(), row_starts_.end(), row_starts_.begin());
  entries_.resize(static_cast<std::size_t>(starts[n]));
  std::vector<int> next = row_starts_;
  for (int column = 0; column < n; ++column)
    for (int k = starts[column]; k < starts[column + 1]; ++k) entries_[next[rows[k]]++] = {column, k};
}

void StepTangent::take(const State& before, const IntegratorHistory& history, const State& after,
                       bool repeated) {
  step_.take(before, history, after, repeated);
}

bool StepTangent::factorise() { return solver_.factorise(step_.kkt); }

MotionTangents StepTangent::end(const MotionTangents& start, const Eigen::RowVectorXd& step,
                                const Matrix& dynamics, const Matrix& constraints) const {
  using Start = LinearStep::Start;
  const Eigen::Index n = start.q.rows(), m = start.lambda.rows();
  const bool other_length = !step.isZero(0);
  const double h = step_.h;
  Matrix moved;
  if (step_.start == Start::moved) {
    moved = start.algorithmic_acceleration + step_.lag() * (h - step_.last_step) * start.jerk;
    if (step != start.last_step) moved.noalias() += step_.lag() * step_.jerk * (step - start.last_step);
  }
  const Matrix& alg = step_.start == Start::moved    ? moved
                      : step_.start == Start::afresh ? start.a
                                                     : start.algorithmic_acceleration;

  MotionTangents end;
  end.t = start.t + step;
  end.last_step = step;
  for (Matrix* each : {&end.q, &end.v, &end.a, &end.algorithmic_acceleration, &end.jerk})
    each->resize(n, start.parameters());
  predict(start, alg, end);
  if (other_length) {
    end.q.noalias() += step_.q_by_length() * step;
    end.v.noalias() += step_.v_by_length() * step;
  }

  // The correction of q for which the residual stays zero, and the quantities that follow it.
  Matrix rhs(n + m, start.parameters()), x;
  find_rhs(end, dynamics, constraints, rhs);
  solver_.solve(rhs, x);
  correct(x, alg, end);
  end.lambda = x.bottomRows(m) / step_.scale();
  if (other_length) end.jerk.noalias() -= (step_.end_algorithmic - step_.start_algorithmic) / (h * h) * step;
  return end;
}

// Predicts the end with the algorithmic acceleration for which a is zero: M then has no part in the residual.
NURBEAM_FOR_EVERY_PROCESSOR void StepTangent::predict(const MotionTangents& start, const Matrix& algorithmic,
                                                      MotionTangents& end) const {
  const auto& [alpha_m, alpha_f, beta, gamma, error] = step_.parameters;
  const double h = step_.h;
  const Prediction of{.h = h,
                      .a_of_start = -alpha_m / (1 - alpha_m),
                      .a_of_before = alpha_f / (1 - alpha_m),
                      .q_of_start = h * h * (0.5 - beta),
                      .q_of_end = h * h * beta,
                      .v_of_start = h * (1 - gamma),
                      .v_of_end = h * gamma};
  const Eigen::Index size = end.q.size(), even = size / 4 * 4;
  of.find<Four>(start, algorithmic, end, 0, even);
  of.find<One>(start, algorithmic, end, even, size);
}

// Corrects the end by the correction of q, the first rows of x.
NURBEAM_FOR_EVERY_PROCESSOR void StepTangent::correct(const Matrix& x, const Matrix& algorithmic,
                                                      MotionTangents& end) const {
  const auto& [alpha_m, alpha_f, beta, gamma, error] = step_.parameters;
  const double h = step_.h, acceleration = 1 / (beta * h * h);
  const Correction of{.acceleration = acceleration,
                      .v = gamma * h * acceleration,
                      .a = (1 - alpha_m) / (1 - alpha_f) * acceleration,
                      .per_step = 1 / h};
  const Eigen::Index size = end.q.size(), even = size / 4 * 4;
  of.make<Four>(x, algorithmic, end, 0, even);
  of.make<One>(x, algorithmic, end, even, size);
}

// Finds -(change + D v + K q), with the rows of constraints, G q, for `times` times as many parameters as
// there are lanes, from the `first` one on. The rows of the dynamics are scaled as the matrix is.
template <class Lanes, int times>
NURBEAM_WITHIN void StepTangent::find_rhs_of(const MotionTangents& end, const Matrix& dynamics,
                                             const Matrix& constraints, Eigen::Index first,
                                             Matrix& rhs) const {
  const Eigen::Index stride = rhs.cols(), n = dynamics.rows();
  const double *q = end.q.data() + first, *v = end.v.data() + first;
  const double *K = step_.stiffness.valuePtr(), *D = step_.damping.valuePtr();
  const int* starts = row_starts_.data();
  const auto find_row = [&](Eigen::Index row, const double* change, double factor) {
    typename Lanes::Side sum[times];
    for (int c = 0; c < times; ++c) sum[c] = side<Lanes>(change + c * width<Lanes>);
    for (const Entry *k = entries_.data() + starts[row], *last = entries_.data() + starts[row + 1]; k < last;
         ++k) {
      const double value = K[k->value];
      const double* of = q + k->column * stride;
      for (int c = 0; c < times; ++c) sum[c] += value * side<Lanes>(of + c * width<Lanes>);
    }
    for (int k = starts[row]; step_.damped && k < starts[row + 1]; ++k) {
      const auto [column, value] = entries_[k];
      if (D[value] == 0) continue;  // most are zero: elements with fixed ends, without damping
      for (int c = 0; c < times; ++c)
        sum[c] += D[value] * side<Lanes>(v + column * stride + c * width<Lanes>);
    }
    double* result = rhs.data() + row * stride + first;
    for (int c = 0; c < times; ++c) side<Lanes>(result + c * width<Lanes>) = -factor * sum[c];
  };
  const double scale = step_.scale();
  for (Eigen::Index row = 0; row < n; ++row) find_row(row, dynamics.data() + row * stride + first, scale);
  for (Eigen::Index row = n; row < rhs.rows(); ++row)
    find_row(row, constraints.data() + (row - n) * stride + first, 1);
}

NURBEAM_FOR_EVERY_PROCESSOR void StepTangent::find_rhs(const MotionTangents& end, const Matrix& dynamics,
                                                       const Matrix& constraints, Matrix& rhs) const {
  const Eigen::Index parameters = rhs.cols();
  Eigen::Index first = 0;
  for (; first + 20 <= parameters; first += 20) find_rhs_of<Four, 5>(end, dynamics, constraints, first, rhs);
  switch ((parameters - first) / 4) {
    case 4:
      find_rhs_of<Four, 4>(end, dynamics, constraints, first, rhs);
      break;
    case 3:
      find_rhs_of<Four, 3>(end, dynamics, constraints, first, rhs);
      break;
    case 2:
      find_rhs_of<Four, 2>(end, dynamics, constraints, first, rhs);
      break;
    case 1:
      find_rhs_of<Four, 1>(end, dynamics, constraints, first, rhs);
      break;
    default:
      break;
  }
  for (first = parameters / 4 * 4; first < parameters; ++first)
    find_rhs_of<One, 1>(end, dynamics, constraints, first, rhs);
}

}  // namespace nurbeam
