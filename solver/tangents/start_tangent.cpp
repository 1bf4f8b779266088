#include "solver/tangents/start_tangent.h"

#include <algorithm>
#include <utility>

#include "solver/algebra/local_solution.h"
#include "solver/system/consistent.h"
#include "solver/system/scaled_kkt.h"

namespace nurbeam {

namespace {

using Columns = MotionTangents::Matrix;
using Tangent = Eigen::SparseMatrix<double>;

// Adds a matrix times a factor to one with the same pattern.
void add(double factor, const Tangent& part, Tangent& sum) {
  using Values = Eigen::ArrayXd;
  Eigen::Map<Values>(sum.valuePtr(), sum.nonZeros()) +=
      factor * Eigen::Map<const Values>(part.valuePtr(), part.nonZeros());
}

// The block of coordinates of a matrix times columns.
Columns product(const Tangent& matrix, const Columns& columns) {
  Columns padded = Columns::Zero(matrix.cols(), columns.cols());
  padded.topRows(columns.rows()) = columns;
  const Columns whole = matrix * padded;  // row by row, side by side
  return whole.topRows(columns.rows());
}

// The states whose residuals make up rho, each with its factor.
std::vector<std::pair<State, double>> parts_of_rho(const SecondOrderSystem& system, double h,
                                                   const Eigen::VectorXd& smoothed, const State& state) {
  std::vector<std::pair<State, double>> parts{{state, 1}};
  if (h == 0) return parts;
  const Eigen::VectorXd d = h * h / 4 * smoothed;
  const double e = small_part(system, d);
  State still = state;
  still.a.setZero();
  still.lambda = Eigen::VectorXd::Zero(system.constraint_count());
  for (const double by : {e, -e}) {
    parts.emplace_back(still, 1 / (2 * by));
    parts.back().first.q += by * d;
    parts.back().first.v += by * h / 2 * smoothed;
  }
  return parts;
}

}  // namespace

StartTangent::StartTangent(const SecondOrderSystem& system, double h, const State& state)
    : StartTangent(system, h, {}, Eigen::VectorXd::Zero(state.a.size()), state) {
  smoothing_ = {};
}

StartTangent::StartTangent(const SecondOrderSystem& system, double h, const std::vector<int>& around,
                           const Eigen::VectorXd& before, const State& state)
    : stiffness_(system.tangent_pattern().matrix()), damping_(stiffness_) {
  if (system.forces_depend_on_multipliers()) return;
  Tangent damping = damping_;
  std::vector<std::pair<State, double>> parts = parts_of_rho(system, h, state.a - before, state);
  parts_.reserve(parts.size());
  for (auto& [each, factor] : parts) {
    Tangent stiffness = system.tangent_pattern().matrix();
    system.tangents(each, {TangentWeights{.stiffness = 1}, {.damping = 1}}, {&stiffness, &damping});
    add(factor, damping, damping_);
    add(factor, stiffness, stiffness_);
    parts_.push_back({std::move(each), factor, std::move(stiffness)});
  }
  State still = state;
  still.a.setZero();
  still.lambda.setZero();
  const ScaledKkt kkt(system, still, h);
  kkt_ = kkt.matrix;
  scale_ = kkt.scale;
  smoothing_ = system.tangent_pattern().matrix();
  system.tangent(still, {.damping = h / 2, .stiffness = h * h / 4}, smoothing_);
  unknowns_ = solved_near(system, around);
  regular_ = unknowns_.empty() ? solver_.factorise(kkt_, system.moving_unknowns())
                               : solver_.factorise(submatrix(kkt_, unknowns_));
}

double small_part(const SecondOrderSystem& system, const Eigen::VectorXd& d) {
  constexpr double small = 1e-5;  // relative to the coordinates' sizes: its square counts as an error, and
                                  // round-off is divided by it
  const double size = d.cwiseQuotient(system.coordinate_scale()).lpNorm<Eigen::Infinity>();
  return size > small ? small / size : 1;
}

void StartTangent::find(const Matrix& dynamics, const Matrix& curvature, MotionTangents& tangents) const {
  const Eigen::Index n = dynamics.rows(), m = curvature.rows();
  Matrix change = dynamics + product(stiffness_, tangents.q) + product(damping_, tangents.v);
  if (smoothing_.size() > 0) change -= product(smoothing_, tangents.a);
  Matrix right(n + m, dynamics.cols()), left;
  right << -change / scale_, -curvature;
  if (unknowns_.empty()) {
    solver_.solve(right, left);
  } else {
    left.resize(n + m, dynamics.cols());
    left << tangents.a, tangents.lambda / scale_;
    right -= kkt_ * left;
    const Matrix open = right(unknowns_, Eigen::all);
    Matrix correction;
    solver_.solve(open, correction);
    left(unknowns_, Eigen::all) += correction;
  }
  tangents.a = left.topRows(n);
  tangents.lambda = scale_ * left.bottomRows(m);
}

}  // namespace nurbeam
