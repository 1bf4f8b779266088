#pragma once
#include <optional>

#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/held_angle.h"
#include "fem/constraints/node_section.h"

namespace nurbeam {

/// A hinge with an axis: a section turns about this axis alone, against space or against another section.
/// The axis u is fixed there, and v, w across it are fixed in the section: u . v = u . w = 0. 2 rows, regular
/// at any angle unless the axis is reversed; coordinates (r_s, angle) of the section, then of the other one.
class HeldAxis {
 public:
  /// `axis`: as drawn, of any length but zero; with `other` it is fixed in that section.
  HeldAxis(const NodeSection& section, const Eigen::Vector3d& axis) : section_(section) { set(axis); }
  HeldAxis(const NodeSection& section, const NodeSection& other, const Eigen::Vector3d& axis)
      : section_(section), other_(other) {
    set(axis);
  }

  static constexpr ConstraintOffers offers{.couple = true};
  static constexpr int rows = 2;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state,
                           const ConstraintTerms<3>::Multipliers* y) const;
  /// The couple for its multipliers [N m]: of a support on the section, of a joint on the other section.
  Eigen::Vector3d couple(const MeshedBeams<3>&, const State& state,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const;

 private:
  template <class T>
  using Vector8 = Eigen::Matrix<T, 8, 1>;

  void set(const Eigen::Vector3d& axis) {
    const Eigen::Vector3d u = axis.normalized(), v = u.unitOrthogonal(), w = u.cross(v);
    axis_ = other_ ? Eigen::Vector3d(other_->drawn.transpose() * u) : u;
    across_ << section_.drawn.transpose() * v, section_.drawn.transpose() * w;
    dofs_.assign(section_.dofs.begin(), section_.dofs.end());
    if (other_) dofs_.insert(dofs_.end(), other_->dofs.begin(), other_->dofs.end());
  }
  Vector8<double> coordinates(const Eigen::VectorXd& q) const {
    Vector8<double> x = Vector8<double>::Zero();
    x.head<4>() = section_.coordinates(q);
    if (other_) x.tail<4>() = other_->coordinates(q);
    return x;
  }
  // The axis u in a state.
  template <class T>
  Vector3<T> axis(const Vector8<T>& x) const {
    const Vector3<T> own = axis_.cast<T>();
    return other_ ? Vector3<T>(other_->triad<T>(x.template tail<4>()).matrix() * own) : own;
  }
  // y1 v + y2 w in a state.
  template <class T>
  Vector3<T> across(const Vector8<T>& x, const Eigen::Vector2d& y) const {
    const Eigen::Vector3d own = across_ * y;
    return section_.triad<T>(x.template head<4>()).matrix() * own.cast<T>();
  }
  // Gradient of y . g.
  template <class T>
  Vector8<T> gradient(const Vector8<T>& x, const Eigen::Vector2d& y) const {
    const Vector3<T> u = axis<T>(x), v = across<T>(x, y);
    const Vector3<T> on_section = v.cross(u), on_other = u.cross(v);
    Vector8<T> g = Vector8<T>::Zero();
    g.template head<4>() = section_.force<T>(x.template head<4>(), on_section);
    if (other_) g.template tail<4>() = other_->force<T>(x.template tail<4>(), on_other);
    return g;
  }

  NodeSection section_;
  std::optional<NodeSection> other_;
  Eigen::Vector3d axis_;                // in the drawn axes of the other section, or in space
  Eigen::Matrix<double, 3, 2> across_;  // v and w in the axes of the section
  std::vector<int> dofs_;
};

}  // namespace nurbeam
