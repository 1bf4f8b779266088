#pragma once
#include "fem/constraints/constraint_offers.h"
#include "fem/constraints/node_section.h"

namespace nurbeam {

/// Two sections keep the relative orientation of the drawing: sections of two beams at a rigid joint, or of
/// one beam before and after a corner. 3 rows; coordinates (r_s, angle) of both.
///
/// g = sum_i a_i x b_i/2 = 0, where a_i is the triad of the first section and b_i = sum_j C0_ij d_j the triad
/// that it should have by the second one. Where g = 0 its variation is the difference of both spins, so the
/// multiplier is the moment [N m]. g also vanishes where the sections are turned by 180 degrees.
class JoinedSections {
 public:
  JoinedSections(const NodeSection& a, const NodeSection& b)
      : a_(a), b_(b), relative_(a.drawn.transpose() * b.drawn) {
    for (const NodeSection* node : {&a, &b}) dofs_.insert(dofs_.end(), node->dofs.begin(), node->dofs.end());
  }

  static constexpr ConstraintOffers offers{.couple = true};
  static constexpr int rows = 3;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state,
                           const ConstraintTerms<3>::Multipliers* y) const;
  /// The couple on the first section for its multipliers [N m].
  Eigen::Vector3d couple(const MeshedBeams<3>&, const State& state,
                         const Eigen::Ref<const Eigen::VectorXd>& y) const;

 private:
  template <class T>
  using Vector8 = Eigen::Matrix<T, 8, 1>;
  template <class T>
  struct Triads {
    Eigen::Matrix<T, 3, 3> a, b;  // columns a_i and b_i
  };
  template <class T>
  Triads<T> triads(const Vector8<T>& x) const {
    return {a_.triad<T>(x.template head<4>()).matrix(),
            b_.triad<T>(x.template tail<4>()).matrix() * relative_.transpose().cast<T>()};
  }
  // Moments by which y . g changes with the spins of both sections.
  template <class T>
  struct Moments {
    Vector3<T> a, b;
  };
  template <class T>
  Moments<T> moments(const Triads<T>& both, const Eigen::Vector3d& y) const {
    const Vector3<T> direction = y.cast<T>();
    Moments<T> on{Vector3<T>::Zero(), Vector3<T>::Zero()};
    for (int i = 0; i < 3; ++i) {
      const Vector3<T> a = both.a.col(i), b = both.b.col(i);
      on.a += a.cross(b.cross(direction)) / 2.0;
      on.b += b.cross(direction.cross(a)) / 2.0;
    }
    return on;
  }
  // Gradient of y . g.
  template <class T>
  Vector8<T> gradient(const Vector8<T>& x, const Eigen::Vector3d& y) const {
    const Triads<T> both = triads<T>(x);
    const Moments<T> on = moments<T>(both, y);
    Vector8<T> g;
    g << a_.force<T>(x.template head<4>(), on.a), b_.force<T>(x.template tail<4>(), on.b);
    return g;
  }

  NodeSection a_, b_;
  Eigen::Matrix3d relative_;  // C0: columns are the drawn axes of B in the axes of A
  std::vector<int> dofs_;
};

}  // namespace nurbeam
