#pragma once
#include <Eigen/SparseCore>
#include <cmath>
#include <limits>

#include "solver/system/second_order_system.h"

namespace nurbeam {

/// The equations in scaled unknowns x = (q / coordinate scale, lambda / multiplier scale) and scaled rows.
///
/// With proximity p > 0 and its centre q_k the dynamics have a = p (q - q_k), v = 0.
class ScaledEquations {
 public:
  using Matrix = Eigen::SparseMatrix<double>;
  using Vector = Eigen::VectorXd;

  ScaledEquations(const SecondOrderSystem& system, const State& start)
      : system_(system),
        n_(system.coordinate_count()),
        m_(system.constraint_count()),
        state_(start),
        tangent_(system.tangent_pattern().matrix()),
        unknown_scale_(Vector::Ones(n_ + m_)),
        row_factor_(Vector::Ones(n_ + m_)) {
    state_.v.setZero(n_);
    state_.a.setZero(n_);
    unknown_scale_.head(n_) = system.coordinate_scale();
  }

  int size() const { return n_ + m_; }
  int coordinates() const { return n_; }
  const Matrix& tangent() const { return tangent_; }

  /// Sets the scales for forces of the size `work` over coordinate scale, and for constraints as large as in
  /// `state`.
  void rescale(const State& state, double work) {
    evaluate_tangent(state, {.stiffness = 1});
    Vector constraint_size = Vector::Zero(m_);
    for (int column = 0; column < n_; ++column)
      for (Matrix::InnerIterator entry(tangent_, column); entry; ++entry)
        if (entry.row() >= n_)
          constraint_size[entry.row() - n_] += std::abs(entry.value()) * unknown_scale_[column];
    constraint_size = (constraint_size.array() > 0).select(constraint_size, 1.0);
    row_factor_.head(n_) = unknown_scale_.head(n_) / work;
    row_factor_.tail(m_) = constraint_size.cwiseInverse();
    unknown_scale_.tail(m_) = work * constraint_size.cwiseInverse();
  }

  /// The largest work of inertia over coordinate scale per unit of proximity.
  double inertial_work(const State& state) {
    evaluate_tangent(state, {.mass = 1});
    const Vector diagonal = tangent_.diagonal().head(n_);
    return (diagonal.array() * unknown_scale_.head(n_).array().square()).maxCoeff();
  }

  /// Sets the load factor of the states of scaled unknowns (State::load).
  void set_load(double factor) { state_.load = factor; }
  void set_proximity(double proximity, const Vector& centre) {
    proximity_ = proximity;
    centre_ = centre;
  }
  void clear_proximity() { set_proximity(0, Vector::Zero(n_)); }

  Vector scaled_unknowns(const State& state) const {
    Vector x(size());
    x << state.q, state.lambda;
    return x.cwiseQuotient(unknown_scale_);
  }

  /// The state of scaled unknowns, with the acceleration of the proximity.
  const State& state_of(const Eigen::Ref<const Vector>& x) {
    state_.q = x.head(n_).cwiseProduct(unknown_scale_.head(n_));
    state_.lambda = x.tail(m_).cwiseProduct(unknown_scale_.tail(m_));
    if (proximity_ > 0)
      state_.a = proximity_ * (state_.q - centre_);
    else
      state_.a.setZero();
    return state_;
  }

  /// Evaluates the scaled residual at `x` into `rows`; returns whether the configuration is admissible and
  /// all is finite.
  [[nodiscard]] bool evaluate(const Eigen::Ref<const Vector>& x, Eigen::Ref<Vector> rows) {
    const State& state = state_of(x);
    if (!x.allFinite() || !system_.admissible(state)) return false;
    system_.residual(state, rows.head(n_), rows.tail(m_));
    rows = rows.cwiseProduct(row_factor_);
    return rows.allFinite();
  }

  /// Evaluates the scaled derivative of the rows at `x` into tangent(); returns whether it is finite.
  [[nodiscard]] bool differentiate(const Eigen::Ref<const Vector>& x) {
    evaluate_scaled_tangent(state_of(x), {.mass = proximity_, .stiffness = 1});
    return tangent_.coeffs().allFinite();
  }

  /// (n x n) The derivative of the dynamics by accelerations, scaled as tangent(), which it overwrites.
  Matrix inertia(const State& state) {
    evaluate_scaled_tangent(state, {.mass = 1});
    return tangent_.topLeftCorner(n_, n_);
  }

  /// The largest scaled residual at `x`, and the allowed size of each row: `tolerance` and its own round-off.
  /// A residual that cannot be evaluated is infinite.
  struct Quality {
    Vector allowed;
    double residual_norm = std::numeric_limits<double>::infinity();
    bool acceptable = false;
  };
  Quality quality(const Vector& x, double tolerance) {
    Vector rows(size());
    Vector allowed = Vector::Constant(size(), tolerance);
    if (!evaluate(x, rows) || !differentiate(x)) return {.allowed = allowed};
    for (int column = 0; column < size(); ++column)
      for (Matrix::InnerIterator entry(tangent_, column); entry; ++entry)
        allowed[entry.row()] += round_off * std::abs(entry.value()) * (std::abs(x[column]) + 1);
    return {allowed, rows.lpNorm<Eigen::Infinity>(), (rows.cwiseAbs().array() <= allowed.array()).all()};
  }

 private:
  static constexpr double round_off = 8 * std::numeric_limits<double>::epsilon();

  void evaluate_tangent(const State& state, const TangentWeights& weights) {
    system_.tangent(state, weights, tangent_);
  }
  void evaluate_scaled_tangent(const State& state, const TangentWeights& weights) {
    evaluate_tangent(state, weights);
    for (int column = 0; column < size(); ++column)
      for (Matrix::InnerIterator entry(tangent_, column); entry; ++entry)
        entry.valueRef() *= row_factor_[entry.row()] * unknown_scale_[column];
  }

  const SecondOrderSystem& system_;
  int n_;
  int m_;
  State state_;
  Matrix tangent_;
  Vector unknown_scale_;
  Vector row_factor_;
  double proximity_ = 0;
  Vector centre_;
};

}  // namespace nurbeam
