#include "fem/element/twist_stiffness.h"

#include "fem/element/cross_matrix.h"

namespace nurbeam::twist {

namespace {

constexpr int points = GaussRule::size;
template <class T>
using Row = Eigen::Matrix<T, 1, reduced>;
template <class T>
using Rows = Eigen::Matrix<T, 3, reduced>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
using Square = Eigen::Matrix<double, reduced, reduced>;

template <class T>
Matrix3<T> crossing(const Vector3<T>& x) {
  const T none(0.0);
  Matrix3<T> y;
  y << none, -x[2], x[1], x[2], none, -x[0], -x[1], x[0], none;
  return y;
}

// First derivatives by x: the spins of both ends; theta_B; and at each point those of (r_s, r_ss), as seen
// from the section at A, of t and K in r_s, of the curvatures P1, P2 along the axes of the section at A, of
// the rate of transport f, of alpha and of the strains.
template <class T>
struct FirstDerivatives {
  std::array<Rows<T>, 2> spins;
  Row<T> twist;
  std::array<Eigen::Matrix<T, 6, reduced>, points> V;
  std::array<Matrix3<T>, points> t_rs, K_rs;
  std::array<Row<T>, points> P1, P2, f, alpha;
  std::array<Rows<T>, points> strain;

  FirstDerivatives(const Drawing<double, points>& drawing, const std::array<Eigen::Matrix3d, 2>& charts,
                   const Fields<T, points>& fields) {
    set_nodes(charts, fields);
    for (int g = 0; g < points; ++g) {
      set_axis(drawing.points[g], fields, g);
      twist -= drawing.weights[g] * f[g];
    }
    for (int g = 0; g < points; ++g) set_strain(drawing, fields, g);
  }

 private:
  void set_nodes(const std::array<Eigen::Matrix3d, 2>& charts, const Fields<T, points>& fields) {
    for (const int end : {0, 1}) {
      const Vector3<T> rs = fields.x.template segment<3>(slope_of(end)),
                       t = end == 0 ? fields.a.t : fields.b.t;
      spins[end].setZero();
      spins[end].template middleCols<3>(slope_of(end)) =
          crossing<T>(rs) / rs.dot(rs) + t * spin_row<T>(charts[end], rs).transpose();
      spins[end].col(angle_of(end)) = t;
    }
    const TurnGradient<T> turn(fields.a, fields.b);
    twist = turn.on_a.transpose() * spins[0] + turn.on_b.transpose() * spins[1];
  }

  void set_axis(const Point<double, points>& place, const Fields<T, points>& fields, int g) {
    const SectionTriad<T>& a = fields.a;
    const PointField<T>& p = fields.at[g];
    V[g].template topRows<3>() = crossing<T>(p.rs) * spins[0];
    V[g].template bottomRows<3>() = crossing<T>(p.rss) * spins[0];
    for (int k = 0; k < 3; ++k)
      for (int d = 0; d < 3; ++d) {
        V[g](d, 3 * k + d) += place.S1[k];
        V[g](3 + d, 3 * k + d) += place.S2[k];
      }
    t_rs[g] = (Matrix3<T>::Identity() - p.t * p.t.transpose()) / p.n;
    K_rs[g] = (-crossing<T>(p.rss) - 2.0 * p.K * p.rs.transpose()) / p.a;
    const Matrix3<T> by_rs = K_rs[g] - p.f * t_rs[g], by_rss = crossing<T>(p.rs) / p.a;
    const Rows<T> z = by_rs * V[g].template topRows<3>() + by_rss * V[g].template bottomRows<3>();
    f[g] = a.t.transpose() * z / (1.0 + p.t.dot(a.t));
    P1[g] = a.d1.transpose() * z - p.t.dot(a.d1) * f[g];
    P2[g] = a.d2.transpose() * z - p.t.dot(a.d2) * f[g];
  }

  void set_strain(const Drawing<double, points>& drawing, const Fields<T, points>& fields, int g) {
    const PointField<T>& p = fields.at[g];
    const Point<double, points>& place = drawing.points[g];
    const double h = drawing.h;
    alpha[g] = place.xi * twist;
    Row<T> gamma = twist / h;
    alpha[g][bubble] += bubble_shape(place.xi);
    gamma[bubble] += bubble_slope(place.xi) / h;
    for (int j = 0; j < points; ++j) alpha[g] += place.transport[j] * f[j];
    strain[g].row(0) = p.cosine * P1[g] + p.sine * P2[g] + p.k2 * alpha[g];
    strain[g].row(1) = p.cosine * P2[g] - p.sine * P1[g] - p.k1 * alpha[g];
    strain[g].row(2) = gamma;
  }
};

Eigen::Matrix3d law(const SectionStiffness& section) {
  Eigen::Matrix3d C;
  C << section.bending_1, section.bending_product, 0, section.bending_product, section.bending_2, 0, 0, 0,
      section.torsion;
  return C;
}

// The derivative by x of gradient_of the moments M of a potential, of strains e with dM/de = C: in the steps
// of gradient_of, second derivatives of the strains in P1, P2, f, the turn and the bubble; those of P1, P2, f
// in r_s and r_ss as seen from the section at A; and what its spin adds.
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
    for (int g = 0; g < points; ++g) {
      const PointField<double>& p = fields_.at[g];
      const double w = drawing_.weights[g];
      const auto& [M1, M2, Mt] = moments[g];
      F1_[g] = w * (M1 * p.cosine - M2 * p.sine);
      F2_[g] = w * (M1 * p.sine + M2 * p.cosine);
      Q_[g] = w * (M1 * p.k2 - M2 * p.k1);
      twist_force_ += drawing_.points[g].xi * Q_[g] + w / h * Mt;
      const Row<double>& alpha_x = first_.alpha[g];
      const Row<double> turned =
          F1_[g] * first_.P2[g] - F2_[g] * first_.P1[g] - w / 2 * (M1 * p.k1 + M2 * p.k2) * alpha_x;
      const Rows<double> moments_x = w * C * first_.strain[g];
      H_ += first_.strain[g].transpose().lazyProduct(moments_x);
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
    Rows<double> swept = Rows<double>::Zero();
    for (int j = 0; j < points; ++j) {
      const PointField<double>& p = fields_.at[j];
      const Point<double, points>& place = drawing_.points[j];
      const auto [on_rs, on_rss, second] = on_axis(j);
      const Eigen::Matrix<double, 6, reduced> forces_x = second.lazyProduct(first_.V[j]);
      H_ += first_.V[j].transpose().lazyProduct(forces_x);
      moment_ -= p.rs.cross(on_rs) + p.rss.cross(on_rss);
      by_spin += cross_matrix(p.rs) * cross_matrix(on_rs) + cross_matrix(p.rss) * cross_matrix(on_rss);
      for (int k = 0; k < 3; ++k)
        swept.middleCols<3>(3 * k) += place.S1[k] * cross_matrix(on_rs) + place.S2[k] * cross_matrix(on_rss);
    }
    const Rows<double> turned_x = by_spin * first_.spins[0];
    const Square crossed = first_.spins[0].transpose().lazyProduct(swept);
    H_ += crossed + crossed.transpose();
    H_ += first_.spins[0].transpose().lazyProduct(turned_x);
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
  for (int g = 0; g < points; ++g) {
    Rows<double> rate_x = w.damping * first.strain[g];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < reduced; ++j) rate_x(i, j) += w.stiffness * moving.strain[g](i, j).d[0];
    const Rows<double> moments_x = drawing.weights[g] * C * rate_x;
    K += first.strain[g].transpose().lazyProduct(moments_x);
  }
  return K;
}

}  // namespace nurbeam::twist
