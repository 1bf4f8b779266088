#include "solver/tangents/rest_adjoint.h"

#include <utility>

#include "solver/tangents/rates_by_unknowns.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;

// Relative difference of an unknown. As errors are of fourth order it can be so large that round-off stays
// small. Derivatives by single coordinates nearly cancel in those of a shape that hardly strains.
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

Eigen::MatrixXd RestAdjoint::through_rest(const Quantities& quantities, const Matrix& dynamics,
                                          const Matrix& constraints) const {
  const Eigen::Index n = rest_.q.size(), m = rest_.lambda.size();
  Vector x(n + m);
  x << rest_.q, rest_.lambda;
  const Eigen::MatrixXd by = rates_by_unknowns(
      [&](const Vector& unknowns) {
        State state = rest_;
        state.q = unknowns.head(n);
        state.lambda = unknowns.tail(m);
        return quantities(state);
      },
      x, steps_);
  Eigen::MatrixXd result(by.cols(), dynamics.cols());
  for (Eigen::Index i = 0; i < by.cols(); ++i) {
    const Vector mu = transposed_.solve(by.col(i));
    result.row(i) = -mu.head(n).transpose() * dynamics - mu.tail(m).transpose() * constraints;
  }
  return result;
}

}  // namespace nurbeam
