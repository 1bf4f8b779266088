#pragma once
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/algebra/kkt_solver.h"
#include "solver/system/mass_scale.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// The stabilised equations in unknowns and rows of order one.
///
/// With s the coordinate scale, T the time scale, E = max M_jj s_j^2 and c_k = sum |G_kj| s_j at the start:
/// q = s x, v = s w / T, lambda = E / (c T^2) l, mu = m / (c T); y = (x, w, l, m). Rows, with H_kj = G_kj s_j
/// / c_k:
///
///   T x' - w - H'm,   T^2 s / E (M v' - f + G'lambda),   g / c,   T / c (G v + g_t).
class StabilisedEquations {
 public:
  using Matrix = Eigen::SparseMatrix<double>;
  using Vector = Eigen::VectorXd;
  using VectorRef = Eigen::Ref<Vector>;
  using ConstVectorRef = Eigen::Ref<const Vector>;

  StabilisedEquations(const SecondOrderSystem& system, const State& start, double time_scale)
      : system_(system),
        n_(system.coordinate_count()),
        m_(system.constraint_count()),
        T_(time_scale),
        s_(system.coordinate_scale()),
        state_(start),
        tangent_(system.tangent_pattern().matrix()),
        inertia_(tangent_),
        dynamics_(n_),
        constraints_(m_),
        padded_(Vector::Zero(n_ + m_)) {
    system.tangent(start, {.mass = 1}, tangent_);
    const Vector inertia = tangent_.diagonal().head(n_).cwiseProduct(s_.cwiseAbs2());
    const double E = n_ > 0 ? inertia.maxCoeff() : 1;
    work_ = E > 0 && std::isfinite(E) ? E : 1;
    c_ = Vector::Zero(m_);
    for (int j = 0; j < n_; ++j)
      for (Matrix::InnerIterator entry(tangent_, j); entry; ++entry)
        if (entry.row() >= n_) c_[entry.row() - n_] += std::abs(entry.value()) * s_[j];
    for (double& c : c_) c = c > 0 && std::isfinite(c) ? c : 1;
  }

  int size() const { return 2 * (n_ + m_); }
  int differential_count() const { return 2 * n_; }

  /// Whether M on the null space of G, and G, are regular at `state`; otherwise l and m are not determined.
  bool regular(const State& state) {
    const double scale = mass_scale(system_, state, tangent_);
    system_.tangent(state, {.mass = 1 / scale}, tangent_);
    return KktSolver().factorise(tangent_);
  }

  void write(const State& state, VectorRef y, VectorRef derivative) const {
    y.head(n_) = state.q.cwiseQuotient(s_);
    y.segment(n_, n_) = T_ * state.v.cwiseQuotient(s_);
    y.segment(2 * n_, m_) = T_ * T_ / work_ * c_.cwiseProduct(state.lambda);
    y.tail(m_).setZero();
    derivative.setZero();
    derivative.head(n_) = state.v.cwiseQuotient(s_);
    derivative.segment(n_, n_) = T_ * state.a.cwiseQuotient(s_);
  }

  void read(double t, const ConstVectorRef& y, const ConstVectorRef& derivative, State& state) const {
    state.t = t;
    state.q = s_.cwiseProduct(y.head(n_));
    state.v = s_.cwiseProduct(y.segment(n_, n_)) / T_;
    state.a = s_.cwiseProduct(derivative.segment(n_, n_)) / T_;
    state.lambda = work_ / (T_ * T_) * y.segment(2 * n_, m_).cwiseQuotient(c_);
  }

  enum class Outcome { finite, not_finite, inadmissible };

  Outcome residual(double t, const ConstVectorRef& y, const ConstVectorRef& derivative, VectorRef rows) {
    if (!y.allFinite() || !derivative.allFinite()) return Outcome::not_finite;
    read(t, y, derivative, state_);
    if (!system_.admissible(state_)) return Outcome::inadmissible;
    system_.residual(state_, dynamics_, constraints_);
    rows.head(n_) = T_ * derivative.head(n_) - y.segment(n_, n_);
    rows.segment(n_, n_) = T_ * T_ / work_ * s_.cwiseProduct(dynamics_);
    rows.segment(2 * n_, m_) = constraints_.cwiseQuotient(c_);
    if (m_ > 0) {
      system_.tangent(state_, {}, tangent_);
      padded_.head(n_).setZero();
      padded_.tail(m_) = y.tail(m_).cwiseQuotient(c_);
      rows.head(n_) -= s_.cwiseProduct((tangent_ * padded_).head(n_));
      padded_.head(n_) = state_.v;
      padded_.tail(m_).setZero();
      rows.tail(m_) =
          T_ * ((tangent_ * padded_).tail(m_) + system_.constraint_rate(state_)).cwiseQuotient(c_);
    }
    return rows.allFinite() ? Outcome::finite : Outcome::not_finite;
  }

  /// Number of entries of the matrix that jacobian() fills.
  int entry_count() const {
    int dynamic_entries = 0;
    int constraint_entries = 0;
    for (int j = 0; j < n_; ++j)
      for (Matrix::InnerIterator entry(tangent_, j); entry; ++entry)
        ++(entry.row() < n_ ? dynamic_entries : constraint_entries);
    return 2 * n_ + 2 * dynamic_entries + 5 * constraint_entries;
  }

  /// Fills `matrix` with d rows/dy + cj d rows/dy'; returns whether it is finite.
  [[nodiscard]] bool jacobian(double t, double cj, const ConstVectorRef& y, const ConstVectorRef& derivative,
                              SUNMatrix matrix) {
    read(t, y, derivative, state_);
    system_.tangent(state_, {.mass = cj, .damping = 1}, inertia_);
    const double fastest = std::max(1.0, y.segment(n_, n_).lpNorm<Eigen::Infinity>());
    const double dt = std::sqrt(std::numeric_limits<double>::epsilon()) * T_ / fastest;
    state_.t += dt;
    state_.q += dt * state_.v;
    system_.tangent(state_, {.stiffness = 1}, tangent_);
    if (!inertia_.coeffs().allFinite() || !tangent_.coeffs().allFinite()) return false;

    Columns columns(matrix);
    const auto coordinates = [&](int j, auto visit) {
      Matrix::InnerIterator moved(tangent_, j);
      for (Matrix::InnerIterator entry(inertia_, j); entry; ++entry, ++moved)
        if (entry.row() < n_) visit(static_cast<int>(entry.row()), entry.value(), moved.value());
    };
    const auto constraints = [&](int j, auto visit) {
      Matrix::InnerIterator moved(tangent_, j);
      for (Matrix::InnerIterator entry(inertia_, j); entry; ++entry, ++moved) {
        const int k = static_cast<int>(entry.row()) - n_;
        if (k >= 0) visit(k, entry.value() * s_[j] / c_[k], moved.value() * s_[j] / c_[k]);
      }
    };
    const double force = T_ * T_ / work_;
    for (int j = 0; j < n_; ++j) {  // d/dx_j
      columns.add(j, T_ * cj);
      coordinates(
          j, [&](int i, double, double K) { columns.add(n_ + i, force * s_[i] * K * s_[j]); });
      constraints(
          j, [&](int k, double H, double) { columns.add(2 * n_ + k, H); });
      constraints(
          j, [&](int k, double H, double moved) { columns.add(2 * n_ + m_ + k, T_ * (moved - H) / dt); });
      columns.close();
    }
    for (int j = 0; j < n_; ++j) {  // d/dw_j
      columns.add(j, -1);
      coordinates(
          j, [&](int i, double A, double) { columns.add(n_ + i, force * s_[i] * A * s_[j] / T_); });
      constraints(j, [&](int k, double H, double) { columns.add(2 * n_ + m_ + k, H); });
      columns.close();
    }
    for (const int sign : {1, -1})  // d/dl_k, d/dm_k
      for (int k = 0; k < m_; ++k) {
        for (Matrix::InnerIterator entry(inertia_, n_ + k); entry; ++entry)
          if (entry.row() < n_)
            columns.add((sign > 0 ? n_ : 0) + static_cast<int>(entry.row()),
                        sign * entry.value() * s_[entry.row()] / c_[k]);
        columns.close();
      }
    return true;
  }

 private:
  /// Writes a compressed matrix column by column.
  class Columns {
   public:
    explicit Columns(SUNMatrix matrix)
        : starts_(SUNSparseMatrix_IndexPointers(matrix)),
          rows_(SUNSparseMatrix_IndexValues(matrix)),
          values_(SUNSparseMatrix_Data(matrix)) {
      starts_[0] = 0;
    }
    void add(int row, double value) {
      rows_[count_] = row;
      values_[count_++] = value;
    }
    void close() { starts_[++column_] = count_; }

   private:
    sunindextype* starts_;
    sunindextype* rows_;
    double* values_;
    sunindextype column_ = 0;
    sunindextype count_ = 0;
  };

  const SecondOrderSystem& system_;
  int n_;
  int m_;
  double T_;         ///< [s]
  double work_ = 1;  ///< E
  Vector s_;         ///< (n)
  Vector c_;         ///< (m)
  State state_;
  Matrix tangent_;
  Matrix inertia_;
  Vector dynamics_;
  Vector constraints_;
  Vector padded_;  ///< (n+m)
};

}  // namespace nurbeam
