#pragma once
#include <Eigen/Core>
#include <array>

#include "fem/element/jet.h"
#include "fem/element/layout.h"
#include "fem/element/rancf_basis.h"

namespace nurbeam {

/// Coefficients of one shape-function row (value, d1, ...) as series in the end positions, unpacked.
struct RowSeries {
  using Row = Eigen::Vector4d;
  Row value;
  std::array<Row, 2> first;                  ///< d/ds_i
  std::array<std::array<Row, 2>, 2> second;  ///< d2/(ds_i ds_j)

  explicit RowSeries(const std::array<Jet, 4>& row) {
    for (int k = 0; k < 4; ++k) {
      value[k] = row[k].value();
      for (int i = 0; i < 2; ++i) {
        first[i][k] = row[k].d(i);
        for (int j = 0; j < 2; ++j) second[i][j][k] = row[k].d(i, j);
      }
    }
  }
};

/// A vector field x(q) = sum_k row_k(s_a, s_b) e_k at one quadrature point, for the equations of motion: its
/// gradient in q, its rate, and the Hessian contracted with a vector.
template <int D>
class PointField {
 public:
  using Layout = ElementLayout<D>;
  static constexpr int n = Layout::size;
  using Vector = Eigen::Matrix<double, D, 1>;
  using Gradient = Eigen::Matrix<double, D, n>;
  using Nodes = Eigen::Matrix<double, D, 4>;

  PointField(const std::array<Jet, 4>& row, const Nodes& e) : row_(row), value(e * row_.value) {
    for (int k = 0; k < 4; ++k) gradient.template middleCols<D>(k * D).setIdentity() *= row_.value[k];
    for (int i = 0; i < 2; ++i) gradient.col(Layout::place(i)) = e * row_.first[i];
  }

  const RowSeries& row() const { return row_; }

  /// Rate of the row's coefficients for the end velocities w.
  RowSeries::Row row_rate(const std::array<double, 2>& w) const {
    return row_.first[0] * w[0] + row_.first[1] * w[1];
  }
  /// dx/dt at the (moving) quadrature point.
  Vector rate(const Nodes& e, const Nodes& e_rate, const std::array<double, 2>& w) const {
    return e_rate * row_.value + e * row_rate(w);
  }
  /// d(rate)/dq = d(gradient)/dt.
  Gradient rate_gradient(const Nodes& e, const Nodes& e_rate, const std::array<double, 2>& w) const {
    Gradient g;
    const RowSeries::Row c = row_rate(w);
    for (int k = 0; k < 4; ++k) g.template middleCols<D>(k * D).setIdentity() *= c[k];
    for (int i = 0; i < 2; ++i)
      g.col(Layout::place(i)) =
          e_rate * row_.first[i] + e * (row_.second[i][0] * w[0] + row_.second[i][1] * w[1]);
    return g;
  }
  /// K += factor y . d2x/dq2.
  template <class Matrix>
  void add_hessian(const Vector& y, double factor, const Nodes& e, Matrix& K) const {
    const Vector f = factor * y;
    for (int i = 0; i < 2; ++i) {
      for (int k = 0; k < 4; ++k) {
        const Vector block = f * row_.first[i][k];
        K.template block<D, 1>(k * D, Layout::place(i)) += block;
        K.template block<1, D>(Layout::place(i), k * D) += block.transpose();
      }
      for (int j = 0; j < 2; ++j) K(Layout::place(i), Layout::place(j)) += f.dot(e * row_.second[i][j]);
    }
  }

 private:
  RowSeries row_;

 public:
  Vector value;
  Gradient gradient;
};

/// Second rate of x(q) and its gradient in q; needs the row's third derivatives.
template <int D>
struct SecondRate {
  Eigen::Matrix<double, D, 1> value;
  Eigen::Matrix<double, D, element_size<D>> gradient;

  SecondRate(const std::array<Jet, 4>& row, const PointField<D>& field,
             const typename PointField<D>::Nodes& e, const typename PointField<D>::Nodes& e_rate,
             const typename PointField<D>::Nodes& e_second, const std::array<double, 2>& w,
             const std::array<double, 2>& w_rate) {
    const RowSeries& r = field.row();
    RowSeries::Row c2 = r.first[0] * w_rate[0] + r.first[1] * w_rate[1];
    std::array<RowSeries::Row, 2> c1_i, c2_i;
    for (int i = 0; i < 2; ++i) {
      c1_i[i] = r.second[i][0] * w[0] + r.second[i][1] * w[1];
      c2 += c1_i[i] * w[i];
      c2_i[i] = r.second[i][0] * w_rate[0] + r.second[i][1] * w_rate[1];
      for (int j = 0; j < 2; ++j)
        for (int k = 0; k < 2; ++k)
          for (int m = 0; m < 4; ++m) c2_i[i][m] += row[m].d(i, j, k) * w[j] * w[k];
    }
    const RowSeries::Row c1 = field.row_rate(w);
    value = e_second * r.value + 2 * e_rate * c1 + e * c2;
    for (int k = 0; k < 4; ++k) gradient.template middleCols<D>(k * D).setIdentity() *= c2[k];
    for (int i = 0; i < 2; ++i)
      gradient.col(ElementLayout<D>::place(i)) = e_second * r.first[i] + 2 * e_rate * c1_i[i] + e * c2_i[i];
  }
};

/// Velocity and acceleration of the material at one quadrature point that moves over it. With R = dr/dq the
/// velocity is v = dr/dt - r_s ds/dt = N q', N = R - r_s s_q'. The point's weight w(q) and place s(q) are
/// linear in the end positions.
template <int D>
class PointInertia {
 public:
  using Layout = ElementLayout<D>;
  static constexpr int n = Layout::size;
  using Vector = Eigen::Matrix<double, D, 1>;
  using Nodes = Eigen::Matrix<double, D, 4>;
  using Gradient = Eigen::Matrix<double, D, n>;
  using Coordinates = Eigen::Matrix<double, n, 1>;

  struct Motion {
    Nodes e, e_rate, e_second;
    std::array<double, 2> w, w_rate;  ///< velocities and accelerations of the end positions
  };

  PointInertia(const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight, const PointField<D>& r,
               const PointField<D>& rs, const Motion& x)
      : r_(r), rs_(rs), x_(x), r2_(shape.value, r, x.e, x.e_rate, x.e_second, x.w, x.w_rate) {
    s_q_.setZero();
    weight_q_.setZero();
    for (int i = 0; i < 2; ++i) {
      s_q_[Layout::place(i)] = s.d(i);
      weight_q_[Layout::place(i)] = weight.d(i);
      s_rate_ += s.d(i) * x.w[i];
      s_second_ += s.d(i) * x.w_rate[i];
    }
    rs_rate_ = rs.rate(x.e, x.e_rate, x.w);
    acceleration_ = r2_.value - rs_rate_ * s_rate_ - rs.value * s_second_;
    N_ = r.gradient - rs.value * s_q_.transpose();
  }

  /// v = N dq/dt.
  const Gradient& velocity_gradient() const { return N_; }
  double place_rate() const { return s_rate_; }
  const Coordinates& place_gradient() const { return s_q_; }
  const Coordinates& weight_gradient() const { return weight_q_; }

  /// d2r/dt2 at the material point, and its gradients in dq/dt and q; rss: the field r_ss there.
  Vector material_acceleration(const PointField<D>& rss) const {
    return acceleration_ - s_rate_ * (rs_rate_ - s_rate_ * rss.value);
  }
  Gradient material_acceleration_by_velocity(const PointField<D>& rss) const {
    return 2 * (r_.rate_gradient(x_.e, x_.e_rate, x_.w) - s_rate_ * rs_.gradient +
                (s_rate_ * rss.value - rs_rate_) * s_q_.transpose());
  }
  Gradient material_acceleration_by_position(const PointField<D>& rss) const {
    return r2_.gradient - 2 * s_rate_ * rs_.rate_gradient(x_.e, x_.e_rate, x_.w) - s_second_ * rs_.gradient +
           s_rate_ * s_rate_ * rss.gradient;
  }

 private:
  const PointField<D>& r_;
  const PointField<D>& rs_;
  const Motion& x_;
  SecondRate<D> r2_;
  double s_rate_ = 0, s_second_ = 0;
  Coordinates s_q_, weight_q_;
  Vector rs_rate_, acceleration_;
  Gradient N_;
};

}  // namespace nurbeam
