#include "solver/rest_adjoint.h"

#include <utility>

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;

// Differences with an error of the fourth order: their steps can be so large that round-off is small beside
// derivatives by single coordinates, which nearly cancel in those of a shape that hardly strains.
constexpr double part_of_size = 1e-4;

Vector steps_of(const State& rest, const Vector& scale) {
  const double force = rest.lambda.size() > 0 ? rest.lambda.lpNorm<Eigen::Infinity>() : 0;
  Vector steps(scale.size() + rest.lambda.size());
  steps << part_of_size * scale, Vector::Constant(rest.lambda.size(), part_of_size * (force > 0 ? force : 1));
  return steps;
}

}  // namespace

RestAdjoint::RestAdjoint(State rest, Vector scale, const Eigen::SparseMatrix<double>& tangent)
    : rest_(std::move(rest)),
      steps_(steps_of(rest_, scale)),
      transposed_(tangent.transpose(), static_cast<int>(scale.size())) {}

// Q_x (unknowns x quantities).
Eigen::MatrixXd RestAdjoint::by_unknowns(const Quantities& quantities) const {
  const Eigen::Index n = rest_.q.size();
  const auto unknown = [&](State& state, Eigen::Index i) -> double& {
    return i < n ? state.q[i] : state.lambda[i - n];
  };
  const Vector present = quantities(rest_);
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(steps_.size(), present.size());
  const auto where_one_changes = [&](Eigen::Index i, double part) {
    State state = rest_;
    unknown(state, i) += part * steps_[i];
    return quantities(state);
  };
  // By unevenly many steps each, so that nothing cancels.
  const auto change_something = [&](Eigen::Index first, Eigen::Index end) {
    State state = rest_;
    for (Eigen::Index i = first; i < end; ++i)
      unknown(state, i) += (1 + static_cast<double>(i % 7) / 8) * steps_[i];
    return quantities(state) != present;
  };
  const std::function<void(Eigen::Index, Eigen::Index)> find = [&](Eigen::Index first, Eigen::Index end) {
    if (!change_something(first, end)) return;
    if (end - first > 1) {
      find(first, (first + end) / 2);
      find((first + end) / 2, end);
    } else {
      by.row(first) = (8 * (where_one_changes(first, 1) - where_one_changes(first, -1)) -
                       (where_one_changes(first, 2) - where_one_changes(first, -2))) /
                      (12 * steps_[first]);
    }
  };
  if (steps_.size() > 0) find(0, steps_.size());
  return by;
}

Eigen::MatrixXd RestAdjoint::through_rest(const Quantities& quantities, const Matrix& dynamics,
                                          const Matrix& constraints) const {
  const Eigen::MatrixXd by = by_unknowns(quantities);
  Eigen::MatrixXd result(by.cols(), dynamics.cols());
  for (Eigen::Index i = 0; i < by.cols(); ++i) {
    const Vector mu = transposed_.solve(by.col(i));
    result.row(i) = -mu.head(dynamics.rows()).transpose() * dynamics -
                    mu.tail(constraints.rows()).transpose() * constraints;
  }
  return result;
}

}  // namespace nurbeam
