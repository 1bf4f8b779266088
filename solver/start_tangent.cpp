#include "solver/start_tangent.h"

#include <algorithm>
#include <utility>

#include "solver/scaled_kkt.h"

namespace nurbeam {

namespace {

using Columns = MotionTangents::Matrix;
using Tangent = Eigen::SparseMatrix<double>;

// Both of one pattern.
void add(double factor, const Tangent& part, Tangent& sum) {
  using Values = Eigen::ArrayXd;
  Eigen::Map<Values>(sum.valuePtr(), sum.nonZeros()) +=
      factor * Eigen::Map<const Values>(part.valuePtr(), part.nonZeros());
}

// The rows of coordinates of a matrix times columns for these and, where there are, for multipliers.
Columns product(const Tangent& matrix, const Columns& coordinates, const Columns& multipliers = {}) {
  Columns padded = Columns::Zero(matrix.cols(), coordinates.cols());
  padded.topRows(coordinates.rows()) = coordinates;
  padded.middleRows(coordinates.rows(), multipliers.rows()) = multipliers;
  const Columns whole = matrix * padded;  // row by row, side by side
  return whole.topRows(coordinates.rows());
}

// What is averaged, with its factors: near a state with those accelerations and multipliers.
std::vector<std::pair<State, double>> parts_of_average(const SecondOrderSystem& system,
                                                       const TangentWeights& averaged, const State& near,
                                                       const Eigen::VectorXd& b) {
  if (averaged.stiffness == 0) return {};
  const Eigen::VectorXd d = averaged.stiffness * b;
  const double e = small_part(system, d);
  std::vector<std::pair<State, double>> parts;
  for (const double by : {e, -e}) {
    parts.emplace_back(near, 1 / (2 * by));
    parts.back().first.q += by * d;
    parts.back().first.v += by * averaged.damping * b;
  }
  return parts;
}

State unloaded(State state) {
  state.a.setZero();
  state.lambda.setZero();
  return state;
}

}  // namespace

StartTangent::StartTangent(const SecondOrderSystem& system, const TangentWeights& averaged,
                           const State& state)
    : StartTangent(system, averaged, unloaded(state), state) {
  before_ = average_ = {};
}

StartTangent::StartTangent(const SecondOrderSystem& system, const TangentWeights& averaged,
                           const State& before, const State& state)
    : stiffness_(system.tangent_pattern().matrix()), damping_(stiffness_), before_(stiffness_) {
  if (system.forces_depend_on_multipliers()) return;
  Tangent damping = damping_, inertia = before_;
  std::vector<std::pair<State, double>> parts =
      parts_of_average(system, averaged, before, state.a - before.a);
  for (const auto& [each, factor] : parts) {
    system.tangent(each, {.mass = 1}, inertia);
    add(factor, inertia, before_);
  }
  parts.emplace_back(state, 1);
  parts_.reserve(parts.size());
  for (auto& [each, factor] : parts) {
    Tangent stiffness = system.tangent_pattern().matrix();
    system.tangents(each, {TangentWeights{.stiffness = 1}, {.damping = 1}}, {&stiffness, &damping});
    add(factor, damping, damping_);
    add(factor, stiffness, stiffness_);
    parts_.push_back({std::move(each), factor, std::move(stiffness)});
  }
  const ScaledKkt kkt(system, before, averaged);
  kkt_ = kkt.matrix;
  scale_ = kkt.scale;
  average_ = std::move(inertia);
  system.tangent(before, {.damping = averaged.damping, .stiffness = averaged.stiffness}, average_);
  regular_ = solver_.factorise(kkt_, system.moving_unknowns());
}

double small_part(const SecondOrderSystem& system, const Eigen::VectorXd& d) {
  constexpr double small = 1e-5;  // of the coordinates' sizes: its square counts, and round-off over it
  const double size = d.cwiseQuotient(system.coordinate_scale()).lpNorm<Eigen::Infinity>();
  return size > small ? small / size : 1;
}

void StartTangent::find(const Matrix& dynamics, const Matrix& curvature, MotionTangents& tangents) const {
  const Eigen::Index n = dynamics.rows(), m = curvature.rows();
  Matrix change = dynamics + product(stiffness_, tangents.q) + product(damping_, tangents.v);
  if (before_.size() > 0)
    change += product(before_, tangents.a, tangents.lambda) - product(average_, tangents.a);
  Matrix right(n + m, dynamics.cols()), left;
  right << -change / scale_, -curvature;
  solver_.solve(right, left);
  tangents.a = left.topRows(n);
  tangents.lambda = scale_ * left.bottomRows(m);
}

}  // namespace nurbeam
