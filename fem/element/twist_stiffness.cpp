#include "fem/element/twist_stiffness.h"

#include "fem/element/cross_matrix.h"

namespace nurbeam::twist {

namespace {

constexpr int points = GaussRule::size;
template <class T>
using Gradient = Eigen::Matrix<T, reduced, 1>;
template <class T>
using Gradients = Eigen::Matrix<T, reduced, 3>;  // of three scalars, columns
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
using Square = Eigen::Matrix<double, reduced, reduced>;
// Matrices of several points, side by side in columns.
template <int n>
using Stack = Eigen::Matrix<double, reduced, n * points>;

template <class T>
Matrix3<T> crossing(const Vector3<T>& x) {
  const T none(0.0);
  Matrix3<T> y;
  y << none, -x[2], x[1], x[2], none, -x[0], -x[1], x[0], none;
  return y;
}

// Each column of A times x.
template <class T>
Matrix3<T> crossed(const Matrix3<T>& A, const Vector3<T>& x) {
  Matrix3<T> y;
  for (int k = 0; k < 3; ++k) y.col(k) = Vector3<T>(A.col(k)).cross(x);
  return y;
}

// First derivatives by x of theta_B; and at each point: of t and K in r_s, of the curvatures P1, P2 along the
// axes of the section at A, of the rate of transport f, of alpha and of the strains. The spins of both ends
// are derivatives by their (r_s, angle).
template <class T>
struct FirstDerivatives {
  std::array<Eigen::Matrix<T, 4, 3>, 2> spins;
  Gradient<T> twist = Gradient<T>::Zero();
  std::array<Matrix3<T>, points> t_rs, K_rs;
  std::array<Gradients<T>, points> bends;  // of P1, P2, f
  std::array<Gradient<T>, points> alpha;
  std::array<Gradients<T>, points> strain;

  FirstDerivatives(const Drawing<double, points>& drawing, const std::array<Eigen::Matrix3d, 2>& charts,
                   const Fields<T, points>& fields) {
    set_nodes(charts, fields);
    for (int g = 0; g < points; ++g) {
      set_axis(drawing.points[g], fields, g);
      twist -= drawing.weights[g] * bends[g].col(2);
    }
    for (int g = 0; g < points; ++g) set_strain(drawing, fields, g);
  }

 private:
  void set_nodes(const std::array<Eigen::Matrix3d, 2>& charts, const Fields<T, points>& fields) {
    const Vector3<T> turn = turn_gradient<T>(fields.a.t, fields.b.t);
    for (const int end : {0, 1}) {
      const Vector3<T> rs = fields.x.template segment<3>(slope_of(end)),
                       t = end == 0 ? fields.a.t : fields.b.t;
      spins[end].template topRows<3>() =
          spin_row<T>(charts[end], rs) * t.transpose() - crossing<T>(rs) / rs.dot(rs);
      spins[end].row(3) = t.transpose();
      const Eigen::Matrix<T, 4, 1> on_node = spins[end] * turn * T(end == 0 ? -1.0 : 1.0);
      twist.template segment<3>(slope_of(end)) = on_node.template head<3>();
      twist[angle_of(end)] = on_node[3];
    }
  }

  void set_axis(const Point<double, points>& place, const Fields<T, points>& fields, int g) {
    const SectionTriad<T>& a = fields.a;
    const PointField<T>& p = fields.at[g];
    t_rs[g] = (Matrix3<T>::Identity() - p.t * p.t.transpose()) / p.n;
    K_rs[g] = (-crossing<T>(p.rss) - 2.0 * p.K * p.rs.transpose()) / p.a;
    const Vector3<T> along_f = a.t / (1.0 + p.t.dot(a.t));
    Matrix3<T> axes;
    axes << a.d1 - p.t.dot(a.d1) * along_f, a.d2 - p.t.dot(a.d2) * along_f, along_f;
    const Matrix3<T> on_rs = (K_rs[g] - p.f * t_rs[g]).transpose() * axes,
                     on_rss = crossed<T>(axes, p.rs) / p.a;
    bends[g].template bottomRows<3>().setZero();
    for (int k = 0; k < 3; ++k)
      bends[g].template middleRows<3>(3 * k) = place.S1[k] * on_rs + place.S2[k] * on_rss;
    const Eigen::Matrix<T, 4, 3> on_a = spins[0] * (crossed<T>(on_rs, p.rs) + crossed<T>(on_rss, p.rss));
    bends[g].template middleRows<3>(slope_a) += on_a.template topRows<3>();
    bends[g].row(angle_a) = on_a.row(3);
  }

  void set_strain(const Drawing<double, points>& drawing, const Fields<T, points>& fields, int g) {
    const PointField<T>& p = fields.at[g];
    const Point<double, points>& place = drawing.points[g];
    const double h = drawing.h;
    alpha[g] = place.xi * twist;
    strain[g].col(2) = twist / h;
    alpha[g][bubble] += bubble_shape(place.xi);
    strain[g](bubble, 2) += bubble_slope(place.xi) / h;
    for (int j = 0; j < points; ++j) alpha[g] += place.transport[j] * bends[j].col(2);
    const auto P1 = bends[g].col(0), P2 = bends[g].col(1);
    strain[g].col(0) = p.cosine * P1 + p.sine * P2 + p.k2 * alpha[g];
    strain[g].col(1) = p.cosine * P2 - p.sine * P1 - p.k1 * alpha[g];
  }
};

Eigen::Matrix3d law(const SectionStiffness& section) {
  Eigen::Matrix3d C;
  C << section.bending_1, section.bending_product, 0, section.bending_product, section.bending_2, 0, 0, 0,
      section.torsion;
  return C;
}

// The derivative by x of gradient_of, for moments M of a potential of strains e with dM/de = C. It follows
// the steps of gradient_of: second derivatives of the strains in P1, P2, f, the turn and the bubble; those of
// P1, P2, f in r_s and r_ss as seen from the section at A; and the terms of the spin at A.
class Stiffness {
 public:
  Stiffness(const Drawing<double, points>& drawing, const std::array<Eigen::Matrix3d, 2>& charts,
            const SectionStiffness& section, const Fields<double, points>& fields,
            const FirstDerivatives<double>& first, const Moments& moments)
      : drawing_(drawing), charts_(charts), section_(section), fields_(fields), first_(first) {
    add_strains(moments);
    add_axis();
    add_nodes();
  }

  const Square& matrix() const { return H_; }

 private:
  void add_strains(const Moments& moments) {
    const Eigen::Matrix3d C = law(section_);
    const double h = drawing_.h;
    Stack<5> varied, forces;
    for (int g = 0; g < points; ++g) {
      const PointField<double>& p = fields_.at[g];
      const double w = drawing_.weights[g];
      const auto& [M1, M2, Mt] = moments[g];
      F1_[g] = w * (M1 * p.cosine - M2 * p.sine);
      F2_[g] = w * (M1 * p.sine + M2 * p.cosine);
      Q_[g] = w * (M1 * p.k2 - M2 * p.k1);
      twist_force_ += drawing_.points[g].xi * Q_[g] + w / h * Mt;
      const Gradient<double>& alpha_x = first_.alpha[g];
      const Gradient<double> turned = F1_[g] * first_.bends[g].col(1) - F2_[g] * first_.bends[g].col(0) -
                                      w / 2 * (M1 * p.k1 + M2 * p.k2) * alpha_x;
      varied.middleCols<5>(5 * g) << first_.strain[g], alpha_x, turned;
      forces.middleCols<5>(5 * g) << first_.strain[g].lazyProduct(w * C), turned, alpha_x;
    }
    H_ = varied.lazyProduct(forces.transpose());
  }

  // Forces of a point on (r_s, r_ss), and their derivatives.
  struct OnAxis {
    Eigen::Vector3d on_rs, on_rss;
    // Derivatives of on_rs and on_rss by r_s; by r_ss they are its transpose and 0.
    Eigen::Matrix3d rs_rs, rss_rs;
  };
  OnAxis on_axis(int j) const {
    const SectionTriad<double>& a = fields_.a;
    const PointField<double>& p = fields_.at[j];
    const Eigen::Matrix3d& T = first_.t_rs[j];
    const double opening = 1 + p.t.dot(a.t);
    double y = -drawing_.weights[j] * twist_force_;
    for (int g = 0; g < points; ++g) y += drawing_.points[g].transport[j] * Q_[g];
    y = (y - F1_[j] * p.t.dot(a.d1) - F2_[j] * p.t.dot(a.d2)) / opening;
    const Eigen::Vector3d on_K = F1_[j] * a.d1 + F2_[j] * a.d2 + y * a.t;
    const double kappa = p.K.dot(on_K);
    const Eigen::Vector3d by_K = (p.rss.cross(on_K) - 2 * kappa * p.rs) / p.a, by_t = -p.f * T * on_K;
    const Eigen::Vector3d y_rs = -T * on_K / opening;
    const Eigen::Vector3d f_rs = (first_.K_rs[j] - p.f * T).transpose() * a.t / opening;
    const Eigen::Vector3d kappa_rs = first_.K_rs[j].transpose() * on_K + p.K.dot(a.t) * y_rs;
    const double on_t_along = -p.f * on_K.dot(p.t);
    OnAxis on{by_K + by_t, on_K.cross(p.rs) / p.a, {}, {}};
    on.rs_rs = (p.rss.cross(a.t) * y_rs.transpose() - 2 * p.rs * kappa_rs.transpose() -
                2 * by_K * p.rs.transpose()) /
                   p.a -
               T * (on_K * f_rs.transpose() + p.f * a.t * y_rs.transpose()) -
               (on_t_along * T + p.t * by_t.transpose()) / p.n - by_t * p.rs.transpose() / p.a;
    on.rs_rs.diagonal().array() -= 2 * kappa / p.a;
    on.rss_rs =
        (a.t.cross(p.rs) * y_rs.transpose() + cross_matrix(on_K) - 2 * on.on_rss * p.rs.transpose()) / p.a;
    return on;
  }

  // Adds the axis: (r_s, r_ss) at a point follow from the shape functions, and turn against the spin at A as
  // seen from there.
  void add_axis() {
    Eigen::Matrix<double, 9, 9> shapes = Eigen::Matrix<double, 9, 9>::Zero();
    Eigen::Matrix<double, 9, 3> shapes_spin = Eigen::Matrix<double, 9, 3>::Zero();
    Eigen::Matrix3d spins = Eigen::Matrix3d::Zero();
    for (int j = 0; j < points; ++j) {
      const PointField<double>& p = fields_.at[j];
      const Eigen::Vector3d &S1 = drawing_.points[j].S1, &S2 = drawing_.points[j].S2;
      const auto [on_rs, on_rss, rs_rs, rss_rs] = on_axis(j);
      const Eigen::Matrix3d rs_rss = rss_rs.transpose(), by_rs = cross_matrix(p.rs),
                            by_rss = cross_matrix(p.rss);
      const Eigen::Matrix3d rs_spin = rs_rs * by_rs + rs_rss * by_rss, rss_spin = rss_rs * by_rs;
      const Eigen::Matrix3d across_rs = cross_matrix(on_rs), across_rss = cross_matrix(on_rss);
      moment_ -= p.rs.cross(on_rs) + p.rss.cross(on_rss);
      spins += by_rs * (across_rs - rs_spin) + by_rss * (across_rss - rss_spin);
      for (int k = 0; k < 3; ++k) {
        shapes_spin.middleRows<3>(3 * k) += S1[k] * (rs_spin - across_rs) + S2[k] * (rss_spin - across_rss);
        const Eigen::Matrix3d on_shape = S1[k] * rs_rs + S2[k] * rs_rss, on_second = S1[k] * rss_rs;
        for (int i = 0; i < 3; ++i) shapes.block<3, 3>(3 * i, 3 * k) += S1[i] * on_shape + S2[i] * on_second;
      }
    }
    const Eigen::Matrix<double, 4, 3>& spin_a = first_.spins[0];
    const Eigen::Matrix<double, 9, 4> shapes_node = shapes_spin * spin_a.transpose();
    H_.topLeftCorner<9, 9>() += shapes;
    H_.block<9, 3>(0, slope_a) += shapes_node.leftCols<3>();
    H_.block<9, 1>(0, angle_a) += shapes_node.col(3);
    H_.block<3, 9>(slope_a, 0) += shapes_node.leftCols<3>().transpose();
    H_.block<1, 9>(angle_a, 0) += shapes_node.col(3).transpose();
    add_on_nodes(0, 0, spin_a * spins * spin_a.transpose());
  }

  void add_on_nodes(int end, int by_end, const Eigen::Matrix4d& K) {
    const int i = slope_of(end), k = angle_of(end), j = slope_of(by_end), l = angle_of(by_end);
    H_.block<3, 3>(i, j) += K.topLeftCorner<3, 3>();
    H_.block<3, 1>(i, l) += K.topRightCorner<3, 1>();
    H_.block<1, 3>(k, j) += K.bottomLeftCorner<1, 3>();
    H_(k, l) += K(3, 3);
  }

  // Adds second derivatives at fixed forces: of the spin at A under the moment on all that turns with its
  // section, and of the turn times its force.
  void add_nodes() {
    const std::array<Eigen::Vector3d, 2> t{fields_.a.t, fields_.b.t};
    const double opening = 1 + t[0].dot(t[1]);
    const Eigen::Vector3d turn = turn_gradient<double>(t[0], t[1]);
    for (const int end : {0, 1}) {
      const double sign = end == 0 ? -1 : 1;
      const Eigen::Vector3d on_turn = sign * twist_force_ * turn;
      Eigen::Matrix4d own = Eigen::Matrix4d::Zero();
      own.leftCols<3>() = node_tangent(end, end == 0 ? Eigen::Vector3d(moment_ + on_turn) : on_turn);
      add_on_nodes(end, end, own);
      for (const int by_end : {0, 1}) {
        const Eigen::Vector3d& t_by = t[by_end];
        const double n = fields_.x.segment<3>(slope_of(by_end)).norm();
        const Eigen::Matrix3d turn_t =
            (Eigen::Matrix3d::Identity() - turn * t[1 - by_end].transpose()) / opening;
        const Eigen::Matrix3d turn_rs = (turn_t - turn_t * t_by * t_by.transpose()) / n;
        Eigen::Matrix4d by_turn = Eigen::Matrix4d::Zero();
        by_turn.leftCols<3>() = sign * twist_force_ * first_.spins[end] * turn_rs;
        add_on_nodes(end, by_end, by_turn);
      }
    }
  }

  // The derivative of node_force by the slope at a fixed moment; with c = -(m x r_s)/d.
  Eigen::Matrix<double, 4, 3> node_tangent(int end, const Eigen::Vector3d& mu) const {
    const Eigen::Vector3d rs = fields_.x.segment<3>(slope_of(end)), m = charts_[end].col(2);
    const double a = rs.squaredNorm(), n = std::sqrt(a), along_chart = rs.dot(m), d = a + n * along_chart;
    const Eigen::Vector3d t = rs / n, c = rs.cross(m) / d, d_rs = 2 * rs + along_chart * t + n * m;
    const Eigen::Vector3d along_rs = (mu - mu.dot(t) * t) / n;
    const Eigen::Matrix3d c_rs = -(cross_matrix(m) + c * d_rs.transpose()) / d;
    Eigen::Matrix<double, 4, 3> K;
    K.topRows<3>() = cross_matrix(mu) / a - 2 / (a * a) * mu.cross(rs) * rs.transpose() +
                     c * along_rs.transpose() + mu.dot(t) * c_rs;
    K.row(3) = along_rs.transpose();
    return K;
  }

  const Drawing<double, points>& drawing_;
  const std::array<Eigen::Matrix3d, 2>& charts_;
  const SectionStiffness& section_;
  const Fields<double, points>& fields_;
  const FirstDerivatives<double>& first_;
  std::array<double, points> F1_, F2_, Q_;
  double twist_force_ = 0;
  Eigen::Vector3d moment_ = Eigen::Vector3d::Zero();
  Square H_ = Square::Zero();
};

}  // namespace

Square section_tangent(const Drawing<double, points>& drawing, const std::array<Eigen::Matrix3d, 2>& charts,
                       const SectionStiffness& section, const Fields<double, points>& fields,
                       const Moments& moments, const TangentWeights& w, const Viscosity* viscous) {
  const FirstDerivatives<double> first(drawing, charts, fields);
  Square K = Square::Zero();
  if (w.stiffness != 0)
    K = w.stiffness * Stiffness(drawing, charts, section, fields, first, moments).matrix();
  if (!viscous) return K;
  const FirstDerivatives<Dual<1>> moving(drawing, charts, viscous->moving);
  const Eigen::Matrix3d C = viscous->damping * law(section);
  Stack<3> varied, forces;
  for (int g = 0; g < points; ++g) {
    Gradients<double> rate_x = w.damping * first.strain[g];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < reduced; ++j) rate_x(j, i) += w.stiffness * moving.strain[g](j, i).d[0];
    varied.middleCols<3>(3 * g) = first.strain[g];
    forces.middleCols<3>(3 * g) = rate_x.lazyProduct(drawing.weights[g] * C);
  }
  K += varied.lazyProduct(forces.transpose());
  return K;
}

}  // namespace nurbeam::twist
