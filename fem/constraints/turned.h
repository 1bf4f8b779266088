#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/directions_across.h"
#include "fem/constraints/node_section.h"
#include "fem/mesh/point_on_beam.h"
#include "fem/structure/support.h"

namespace nurbeam {

/// What holds a direction or a section of a beam, turned by the prescribed rotation R(t) of a support. `Rows`
/// has the constraint for any matrix in place of R, in which it is linear: terms(at, state, R, y) and
/// couple(at, state, R, y). Rates and the Hessian by time and coordinates follow from the rates of R.
template <int D, class Rows>
class Turned {
 public:
  using Multipliers = typename ConstraintTerms<D>::Multipliers;
  using Vector = Eigen::Matrix<double, Rows::rows, 1>;

  /// `turn` must outlive the constraint.
  Turned(Rows held, const AxisTurn& turn) : held_(std::move(held)), turn_(&turn) {}

  static constexpr ConstraintOffers offers{.rates = true, .couple = true, .work = true, .drive = true};
  static constexpr int rows = Rows::rows;
  const std::vector<int>& dofs() const { return held_.dofs(); }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state, const Multipliers* y) const {
    return held_.terms(at, state, turn_->at(state.t, state.load).R, y);
  }
  /// dg/dt, and d2g/dt2 + 2 d2g/dt dq v, at fixed q and v.
  Vector rate(const MeshedBeams<D>& at, const State& state) const {
    return held_.terms(at, state, turn_->at(state.t, state.load).first, nullptr).value;
  }
  Vector acceleration(const MeshedBeams<D>& at, const State& state) const {
    const AxisTurn::Rotation now = turn_->at(state.t, state.load);
    Vector sum = held_.terms(at, state, now.second, nullptr).value;
    const ConstraintTerms<D> turning = held_.terms(at, state, now.first, nullptr);
    for (std::size_t k = 0; k < dofs().size(); ++k)
      if (dofs()[k] >= 0) sum += 2 * state.v[dofs()[k]] * turning.gradient.col(static_cast<long>(k));
    return sum;
  }
  /// The couple on the beam for its multipliers [N m].
  Eigen::Vector3d couple(const MeshedBeams<D>& at, const State& state,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return held_.couple(at, state, turn_->at(state.t, state.load).R, y);
  }
  /// Work between two states on one mesh [J]: the mean moment about the axis over the angle.
  double work(const MeshedBeams<D>& at, const State& from, const State& to,
              const Eigen::Ref<const Eigen::VectorXd>& y_from,
              const Eigen::Ref<const Eigen::VectorXd>& y_to) const {
    const double way = to.load * turn_->angle.at(to.t).angle - from.load * turn_->angle.at(from.t).angle;
    return (drive(at, from, y_from) + drive(at, to, y_to)) / 2 * way;
  }
  /// The moment about the axis that turns what is held [N m]: y . dg/d(angle).
  double drive(const MeshedBeams<D>& at, const State& state,
               const Eigen::Ref<const Eigen::VectorXd>& y) const {
    const Eigen::Matrix3d turning = turn_->by(state.load * turn_->angle.at(state.t).angle).first;
    return held_.terms(at, state, turning, nullptr).value.dot(y);
  }

 private:
  Rows held_;
  const AxisTurn* turn_;
};

/// The direction of a clamp that turns: R n . r_s(s) = 0 for the D - 1 directions n across the drawing.
template <int D>
class ClampedDirection {
 public:
  ClampedDirection(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, const Support& support)
      : point_(at, drawn, support.beam, support.s),
        dofs_(point_.dofs(at)),
        across_(directions_across<D>(at.structure.beams[support.beam].curve.tangent(support.s))) {}

  static constexpr int rows = D - 1;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state, const Eigen::Matrix3d& R,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    ConstraintTerms<D> terms(rows, y != nullptr);
    const PointShape<D> shape = point_.shape(at, state.q);
    const PointField<D> rs = shape.slope();
    const Eigen::Matrix<double, rows, D> n = turned(R);
    terms.value = n * rs.value;
    terms.gradient.template leftCols<element_size<D>>() = n * rs.gradient;
    if (y) rs.add_hessian(n.transpose() * y->template head<rows>(), 1, shape.nodes, terms.hessian);
    return terms;
  }
  Eigen::Vector3d couple(const MeshedBeams<D>& at, const State& state, const Eigen::Matrix3d& R,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const {
    const Eigen::Matrix<double, D, 1> on_slope = -turned(R).transpose() * y;
    const Eigen::Matrix<double, D, 1> rs = point_.shape(at, state.q).slope().value;
    return widened<D>(rs).cross(widened<D>(on_slope));
  }

 private:
  Eigen::Matrix<double, rows, D> turned(const Eigen::Matrix3d& R) const {
    return across_ * R.topLeftCorner<D, D>().transpose();
  }

  PointOnBeam<D> point_;
  std::vector<int> dofs_;
  Eigen::Matrix<double, D - 1, D> across_;
};

/// A section that a support holds, in whole or in part: gradient and Hessian of rows whose moments on the
/// section `Held::moment` gives.
template <class Held, int count>
class SectionRows {
 public:
  explicit SectionRows(const NodeSection& node) : node_(node), dofs_(node.dofs.begin(), node.dofs.end()) {}

  static constexpr int rows = count;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state, const Eigen::Matrix3d& R,
                           const ConstraintTerms<3>::Multipliers* y) const {
    ConstraintTerms<3> terms(rows, y != nullptr);
    const Eigen::Vector4d x = node_.coordinates(state.q);
    const Eigen::Matrix3d axes = node_.triad<double>(x).matrix();
    terms.value = own().value(axes, R);
    for (int k = 0; k < rows; ++k)
      terms.gradient.row(k).head<4>() = gradient<double>(x, R, Eigen::Vector3d::Unit(k)).transpose();
    if (!y) return terms;
    const Eigen::Matrix<Dual<4>, 4, 1> g = gradient<Dual<4>>(twist::variables<4, double>(x), R, *y);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) terms.hessian(i, j) = g[i].d[j];
    return terms;
  }
  Eigen::Vector3d couple(const MeshedBeams<3>&, const State& state, const Eigen::Matrix3d& R,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const {
    Eigen::Vector3d padded = Eigen::Vector3d::Zero();
    padded.head<rows>() = y;
    return -own().template moment<double>(node_.triad<double>(node_.coordinates(state.q)).matrix(), R,
                                          padded);
  }

 protected:
  const Eigen::Matrix3d& drawn() const { return node_.drawn; }

 private:
  const Held& own() const { return static_cast<const Held&>(*this); }
  // Of y . g.
  template <class T>
  Eigen::Matrix<T, 4, 1> gradient(const Eigen::Matrix<T, 4, 1>& x, const Eigen::Matrix3d& R,
                                  const Eigen::Vector3d& y) const {
    return node_.force<T>(x, own().template moment<T>(node_.triad<T>(x).matrix(), R, y));
  }

  NodeSection node_;
  std::vector<int> dofs_;
};

/// The section of a clamp that turns: g = sum_i R a_i x d_i/2 = 0 for the drawn axes a_i and the present ones
/// d_i, as JoinedSections. 3 rows; the multiplier is the moment [N m].
class ClampedSection : public SectionRows<ClampedSection, 3> {
 public:
  using SectionRows::SectionRows;
  Eigen::Vector3d value(const Eigen::Matrix3d& axes, const Eigen::Matrix3d& R) const {
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) g += (R * drawn().col(i)).cross(axes.col(i)) / 2;
    return g;
  }
  /// The moment by which y . g changes with the spin of the section.
  template <class T>
  Vector3<T> moment(const Eigen::Matrix<T, 3, 3>& axes, const Eigen::Matrix3d& R,
                    const Eigen::Vector3d& y) const {
    Vector3<T> sum = Vector3<T>::Zero();
    for (int i = 0; i < 3; ++i) {
      const Vector3<T> d = axes.col(i), across = y.cross(Eigen::Vector3d(R * drawn().col(i))).cast<T>();
      sum += d.cross(across) / 2.0;
    }
    return sum;
  }
};

/// A fork that turns: d2 . R d1_0 = 0, as ForkedRoll. 1 row.
class TurnedFork : public SectionRows<TurnedFork, 1> {
 public:
  using SectionRows::SectionRows;
  Eigen::Matrix<double, 1, 1> value(const Eigen::Matrix3d& axes, const Eigen::Matrix3d& R) const {
    return Eigen::Matrix<double, 1, 1>(axes.col(1).dot(R * drawn().col(0)));
  }
  template <class T>
  Vector3<T> moment(const Eigen::Matrix<T, 3, 3>& axes, const Eigen::Matrix3d& R,
                    const Eigen::Vector3d& y) const {
    const Vector3<T> d2 = axes.col(1), along = (y[0] * (R * drawn().col(0))).cast<T>();
    return d2.cross(along);
  }
};

/// A hinge whose axis u turns: R u . v = R u . w = 0 with v, w across it in the section, as HeldAxis. 2 rows.
class TurnedHinge : public SectionRows<TurnedHinge, 2> {
 public:
  /// `axis`: as drawn, of any length but zero.
  TurnedHinge(const NodeSection& node, const Eigen::Vector3d& axis)
      : SectionRows(node), axis_(axis.normalized()) {
    const Eigen::Vector3d v = axis_.unitOrthogonal(), w = axis_.cross(v);
    across_ << node.drawn.transpose() * v, node.drawn.transpose() * w;
  }
  Eigen::Vector2d value(const Eigen::Matrix3d& axes, const Eigen::Matrix3d& R) const {
    return (axes * across_).transpose() * (R * axis_);
  }
  template <class T>
  Vector3<T> moment(const Eigen::Matrix<T, 3, 3>& axes, const Eigen::Matrix3d& R,
                    const Eigen::Vector3d& y) const {
    const Eigen::Vector3d own = across_ * y.head<2>();
    const Vector3<T> v = axes * own.cast<T>(), u = (R * axis_).cast<T>();
    return v.cross(u);
  }

 private:
  Eigen::Vector3d axis_;
  Eigen::Matrix<double, 3, 2> across_;  // v and w in the axes of the section
};

/// A place that slides along a direction which turns: R n . (r(s) - r(t)) = 0 for the D - 1 directions n
/// across it, where r(t) is the drawn place turned about the axis and displaced by d(t).
template <int D>
class TurnedGuide {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using RowVector = Eigen::Matrix<double, D - 1, 1>;

  /// `support`, which turns and has a guide, must outlive the constraint.
  TurnedGuide(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, const Support& support)
      : point_(at, drawn, support.beam, support.s),
        dofs_(point_.dofs(at)),
        across_(directions_across<D>(support.guide->normalized())),
        about_(support.turn->about.head<D>()),
        drawn_(across_ *
               (at.structure.beams[support.beam].curve.position(support.s).template head<D>() - about_)),
        turn_(&*support.turn),
        motion_(support.motion ? &*support.motion : nullptr) {}

  static constexpr ConstraintOffers offers{.rates = true, .force = true, .work = true, .drive = true};
  static constexpr int rows = D - 1;
  const std::vector<int>& dofs() const { return dofs_; }
  /// The force on the beam for its multipliers [N].
  Eigen::Vector3d force(const State& state, const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return widened<D>(Vector(-turned(turn_->at(state.t, state.load).R).transpose() * y));
  }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    ConstraintTerms<D> terms(rows, y != nullptr);
    const PointShape<D> shape = point_.shape(at, state.q);
    const PointField<D> r = shape.position();
    const Eigen::Matrix<double, D - 1, D> n = turned(turn_->at(state.t, state.load).R);
    terms.value = n * from_axis(r.value, state) - drawn_;
    terms.gradient.template leftCols<element_size<D>>() = n * r.gradient;
    if (y) r.add_hessian(n.transpose() * y->template head<rows>(), 1, shape.nodes, terms.hessian);
    return terms;
  }

  /// dg/dt, and d2g/dt2 + 2 d2g/dt dq v, at fixed q and v.
  RowVector rate(const MeshedBeams<D>& at, const State& state) const {
    const AxisTurn::Rotation now = turn_->at(state.t, state.load);
    RowVector sum = turned(now.first) * from_axis(position(at, state).value, state);
    if (motion_) sum -= state.load * turned(now.R) * motion_->at(state.t).rate.template head<D>();
    return sum;
  }
  RowVector acceleration(const MeshedBeams<D>& at, const State& state) const {
    const AxisTurn::Rotation now = turn_->at(state.t, state.load);
    const PointField<D> r = position(at, state);
    Vector velocity = Vector::Zero();
    for (int k = 0; k < element_size<D>; ++k)
      if (dofs_[k] >= 0) velocity += r.gradient.col(k) * state.v[dofs_[k]];
    RowVector sum = turned(now.second) * from_axis(r.value, state);
    if (motion_) {
      const DisplacementTable::Motion d = motion_->at(state.t);
      velocity -= state.load * d.rate.template head<D>();
      sum -= state.load * turned(now.R) * d.acceleration.template head<D>();
    }
    return sum + 2 * turned(now.first) * velocity;
  }

  /// Work between two states on one mesh [J]: the mean moment about the axis over the angle, and the mean
  /// force over the displacement.
  double work(const MeshedBeams<D>& at, const State& from, const State& to,
              const Eigen::Ref<const Eigen::VectorXd>& y_from,
              const Eigen::Ref<const Eigen::VectorXd>& y_to) const {
    const double way = to.load * turn_->angle.at(to.t).angle - from.load * turn_->angle.at(from.t).angle;
    double sum = (drive(at, from, y_from) + drive(at, to, y_to)) / 2 * way;
    if (motion_) {
      const Eigen::Vector3d moved = motion_->at(to.t).value - motion_->at(from.t).value;
      sum += (force(from, y_from) + force(to, y_to)).dot(moved) / 2;
    }
    return sum;
  }
  /// The moment about the axis that turns what is held [N m].
  double drive(const MeshedBeams<D>& at, const State& state,
               const Eigen::Ref<const Eigen::VectorXd>& y) const {
    const Eigen::Matrix3d turning = turn_->by(state.load * turn_->angle.at(state.t).angle).first;
    return y.dot(turned(turning) * from_axis(position(at, state).value, state));
  }

 private:
  Eigen::Matrix<double, D - 1, D> turned(const Eigen::Matrix3d& R) const {
    return across_ * R.topLeftCorner<D, D>().transpose();
  }
  PointField<D> position(const MeshedBeams<D>& at, const State& state) const {
    const PointShape<D> shape = point_.shape(at, state.q);
    return shape.position();
  }
  Vector from_axis(const Vector& r, const State& state) const {
    if (!motion_) return r - about_;
    return r - about_ - state.load * motion_->at(state.t).value.template head<D>();
  }
  PointOnBeam<D> point_;
  std::vector<int> dofs_;
  Eigen::Matrix<double, D - 1, D> across_;
  Vector about_;     // [m]
  RowVector drawn_;  // [m]
  const AxisTurn* turn_;
  const DisplacementTable* motion_;
};

}  // namespace nurbeam
