#include "fem/element/twist_stiffness.h"

#include "fem/element/cross_matrix.h"

namespace nurbeam::twist {

namespace {

constexpr int points = GaussRule::size;
using Row = Eigen::Matrix<double, 1, reduced>;
using Rows = Eigen::Matrix<double, 3, reduced>;
using Square = Eigen::Matrix<double, reduced, reduced>;

// d2U/dx2, in the steps of gradient_of: second derivatives of the strains in the curvatures (P1, P2) along
// the axes of the section at A, in the rates of transport f, in the turn Theta and the bubble; those of P1,
// P2, f in r_s and r_ss as seen from that section; and what its spin adds.
class Stiffness {
 public:
  Stiffness(const Drawing<double, points>& drawing, const std::array<Eigen::Matrix3d, 2>& charts,
            const SectionStiffness& section, const Fields<double, points>& fields)
      : drawing_(drawing), charts_(charts), section_(section), fields_(fields) {
    set_first_derivatives();
    add_strains();
    add_axis();
    add_nodes();
  }

  const Square& matrix() const { return H_; }

 private:
  // Spins of both ends by x; and at each point the derivatives of (r_s, r_ss), as seen from the section at A,
  // of t and K in r_s, and of P1, P2 and f.
  void set_first_derivatives() {
    for (const int end : {0, 1}) {
      const Eigen::Vector3d rs = fields_.x.segment<3>(slope_of(end)),
                            t = end == 0 ? fields_.a.t : fields_.b.t;
      spins_[end].setZero();
      spins_[end].middleCols<3>(slope_of(end)) =
          cross_matrix(rs) / rs.squaredNorm() + t * spin_row<double>(charts_[end], rs).transpose();
      spins_[end].col(angle_of(end)) = t;
    }
    const TurnGradient<double> turn(fields_.a, fields_.b);
    twist_x_ = turn.on_a.transpose() * spins_[0] + turn.on_b.transpose() * spins_[1];
    const SectionTriad<double>& a = fields_.a;
    for (int g = 0; g < points; ++g) {
      const PointField<double>& p = fields_.at[g];
      const Point<double, points>& place = drawing_.points[g];
      V_[g].topRows<3>() = cross_matrix(p.rs) * spins_[0];
      V_[g].bottomRows<3>() = cross_matrix(p.rss) * spins_[0];
      for (int k = 0; k < 3; ++k) {
        V_[g].block<3, 3>(0, 3 * k).diagonal().array() += place.S1[k];
        V_[g].block<3, 3>(3, 3 * k).diagonal().array() += place.S2[k];
      }
      T_[g] = (Eigen::Matrix3d::Identity() - p.t * p.t.transpose()) / p.n;
      K_rs_[g] = (-cross_matrix(p.rss) - 2 * p.K * p.rs.transpose()) / p.a;
      const Rows z_x =
          (K_rs_[g] - p.f * T_[g]) * V_[g].topRows<3>() + cross_matrix(p.rs) / p.a * V_[g].bottomRows<3>();
      f_x_[g] = a.t.transpose() * z_x / (1 + p.t.dot(a.t));
      P1_x_[g] = a.d1.transpose() * z_x - p.t.dot(a.d1) * f_x_[g];
      P2_x_[g] = a.d2.transpose() * z_x - p.t.dot(a.d2) * f_x_[g];
      twist_x_ -= drawing_.weights[g] * f_x_[g];
    }
  }

  void add_strains() {
    Eigen::Matrix3d C;
    C << section_.bending_1, section_.bending_product, 0, section_.bending_product, section_.bending_2, 0, 0,
        0, section_.torsion;
    const double h = drawing_.h;
    for (int g = 0; g < points; ++g) {
      const PointField<double>& p = fields_.at[g];
      const Point<double, points>& place = drawing_.points[g];
      const double w = drawing_.weights[g];
      const auto [M1, M2, Mt] =
          section_moments<double>(section_, {p.k1 - place.k1, p.k2 - place.k2, p.gamma});
      F1_[g] = w * (M1 * p.cosine - M2 * p.sine);
      F2_[g] = w * (M1 * p.sine + M2 * p.cosine);
      Q_[g] = w * (M1 * p.k2 - M2 * p.k1);
      twist_force_ += place.xi * Q_[g] + w / h * Mt;
      Row alpha_x = place.xi * twist_x_, gamma_x = twist_x_ / h;
      alpha_x[bubble] += bubble_shape(place.xi);
      gamma_x[bubble] += bubble_slope(place.xi) / h;
      for (int j = 0; j < points; ++j) alpha_x += place.transport[j] * f_x_[j];
      Rows strain_x;
      strain_x.row(0) = p.cosine * P1_x_[g] + p.sine * P2_x_[g] + p.k2 * alpha_x;
      strain_x.row(1) = p.cosine * P2_x_[g] - p.sine * P1_x_[g] - p.k1 * alpha_x;
      strain_x.row(2) = gamma_x;
      const Row turned = F1_[g] * P2_x_[g] - F2_[g] * P1_x_[g] - w / 2 * (M1 * p.k1 + M2 * p.k2) * alpha_x;
      const Rows moments_x = w * C * strain_x;
      H_ += strain_x.transpose().lazyProduct(moments_x);
      H_ += alpha_x.transpose() * turned + turned.transpose() * alpha_x;
    }
  }

  // Forces of a point on (r_s, r_ss), and their derivatives.
  struct OnAxis {
    Eigen::Vector3d on_rs, on_rss;
    Eigen::Matrix<double, 6, 6> second;
  };
  OnAxis on_axis(int j) const {
    const SectionTriad<double>& a = fields_.a;
    const PointField<double>& p = fields_.at[j];
    const Eigen::Matrix3d& T = T_[j];
    const double opening = 1 + p.t.dot(a.t);
    double y = -drawing_.weights[j] * twist_force_;
    for (int g = 0; g < points; ++g) y += drawing_.points[g].transport[j] * Q_[g];
    y = (y - F1_[j] * p.t.dot(a.d1) - F2_[j] * p.t.dot(a.d2)) / opening;
    const Eigen::Vector3d on_K = F1_[j] * a.d1 + F2_[j] * a.d2 + y * a.t;
    const double kappa = p.K.dot(on_K);
    const Eigen::Vector3d by_K = (p.rss.cross(on_K) - 2 * kappa * p.rs) / p.a, by_t = -p.f * T * on_K;
    const Eigen::Vector3d y_rs = -T * on_K / opening;
    const Eigen::Vector3d f_rs = (K_rs_[j] - p.f * T).transpose() * a.t / opening;
    const Eigen::Vector3d kappa_rs = K_rs_[j].transpose() * on_K + p.K.dot(a.t) * y_rs;
    const double on_t_along = -p.f * on_K.dot(p.t);
    OnAxis on{by_K + by_t, on_K.cross(p.rs) / p.a, Eigen::Matrix<double, 6, 6>::Zero()};
    on.second.topLeftCorner<3, 3>() = (p.rss.cross(a.t) * y_rs.transpose() - 2 * p.rs * kappa_rs.transpose() -
                                       2 * by_K * p.rs.transpose()) /
                                          p.a -
                                      T * (on_K * f_rs.transpose() + p.f * a.t * y_rs.transpose()) -
                                      (on_t_along * T + p.t * by_t.transpose()) / p.n -
                                      by_t * p.rs.transpose() / p.a;
    on.second.topLeftCorner<3, 3>().diagonal().array() -= 2 * kappa / p.a;
    on.second.bottomLeftCorner<3, 3>() =
        (a.t.cross(p.rs) * y_rs.transpose() + cross_matrix(on_K) - 2 * on.on_rss * p.rs.transpose()) / p.a;
    on.second.topRightCorner<3, 3>() = on.second.bottomLeftCorner<3, 3>().transpose();
    return on;
  }

  void add_axis() {
    Eigen::Matrix3d by_spin = Eigen::Matrix3d::Zero();
    Rows swept = Rows::Zero();
    for (int j = 0; j < points; ++j) {
      const PointField<double>& p = fields_.at[j];
      const Point<double, points>& place = drawing_.points[j];
      const auto [on_rs, on_rss, second] = on_axis(j);
      const Eigen::Matrix<double, 6, reduced> forces_x = second.lazyProduct(V_[j]);
      H_ += V_[j].transpose().lazyProduct(forces_x);
      moment_ -= p.rs.cross(on_rs) + p.rss.cross(on_rss);
      by_spin += cross_matrix(p.rs) * cross_matrix(on_rs) + cross_matrix(p.rss) * cross_matrix(on_rss);
      for (int k = 0; k < 3; ++k)
        swept.middleCols<3>(3 * k) += place.S1[k] * cross_matrix(on_rs) + place.S2[k] * cross_matrix(on_rss);
    }
    const Rows turned_x = by_spin * spins_[0];
    const Square crossed = spins_[0].transpose().lazyProduct(swept);
    H_ += crossed + crossed.transpose();
    H_ += spins_[0].transpose().lazyProduct(turned_x);
  }

  // Second derivatives at fixed forces: of the spin at A under the moment on all that turns with its section,
  // and of the turn times its force.
  void add_nodes() {
    constexpr std::array<int, 8> where{slope_a, slope_a + 1, slope_a + 2, angle_a,
                                       slope_b, slope_b + 1, slope_b + 2, angle_b};
    Eigen::Matrix<double, 8, 1> nodes;
    for (int i = 0; i < 8; ++i) nodes[i] = fields_.x[where[i]];
    const auto nodes_x = variables<8, double>(nodes);
    using T = Dual<8>;
    const Eigen::Matrix<T, 4, 1> node_a = nodes_x.head<4>(), node_b = nodes_x.tail<4>();
    const TurnGradient<T> turn(section_at_node<T>(charts_[0], node_a.head<3>(), node_a[3]),
                               section_at_node<T>(charts_[1], node_b.head<3>(), node_b[3]));
    const Vector3<T> on_a = twist_force_ * turn.on_a + moment_.cast<T>(), on_b = twist_force_ * turn.on_b;
    Eigen::Matrix<T, 8, 1> force;
    force << node_force<T>(charts_[0], node_a.head<3>(), on_a),
        node_force<T>(charts_[1], node_b.head<3>(), on_b);
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j) H_(where[i], where[j]) += force[i].d[j];
  }

  const Drawing<double, points>& drawing_;
  const std::array<Eigen::Matrix3d, 2>& charts_;
  const SectionStiffness& section_;
  const Fields<double, points>& fields_;
  std::array<Rows, 2> spins_;
  std::array<Eigen::Matrix<double, 6, reduced>, points> V_;
  std::array<Row, points> P1_x_, P2_x_, f_x_;
  std::array<Eigen::Matrix3d, points> T_, K_rs_;
  Row twist_x_;  // of theta_B
  std::array<double, points> F1_, F2_, Q_;
  double twist_force_ = 0;
  Eigen::Vector3d moment_ = Eigen::Vector3d::Zero();
  Square H_ = Square::Zero();
};

}  // namespace

Eigen::Matrix<double, reduced, reduced> stiffness_of(const Drawing<double, GaussRule::size>& drawing,
                                                     const std::array<Eigen::Matrix3d, 2>& charts,
                                                     const SectionStiffness& section,
                                                     const Fields<double, GaussRule::size>& fields) {
  return Stiffness(drawing, charts, section, fields).matrix();
}

}  // namespace nurbeam::twist
