#pragma once
#include <vector>

#include "fem/forces/energy.h"
#include "fem/forces/force_offers.h"
#include "fem/forces/friction_law.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// Friction of a body that slides along a beam: one generalised force in the equation of its place. A state
/// without memory has no friction.
template <int D>
class SlidingFriction {
 public:
  static constexpr ForceOffers offers{.force = true,
                                      .energy = true,
                                      .loss = true,
                                      .memory = true,
                                      .friction = true,
                                      .depends_on_multipliers = true};
  /// `first_multiplier`: first row of the constraint that ties the body to the beam; its multipliers are the
  /// force of the beam on the body.
  SlidingFriction(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, int rider, int first_multiplier);

  /// Binds the friction of all bodies that are on their beams and not held there.
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const MeshedBeams<D>& at = binding.at;
    for (int j = 0; j < static_cast<int>(at.structure.riders.size()); ++j) {
      const Carried mode = at.mesh.plan.modes[j];
      const bool slides = mode == Carried::node || mode == Carried::point;
      if (at.structure.riders[j].friction && slides && !at.mesh.plan.holds(j))
        add(SlidingFriction(at, binding.drawn, j, binding.ties[j]));
    }
  }

  int rider() const { return rider_; }
  /// Coordinates of the slopes at the body, its place, and its multipliers as coordinates behind all others.
  const std::vector<int>& dofs() const { return dofs_; }

  FrictionForce friction(const MeshedBeams<D>& at, const State& state) const;
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (state.memory.size() > 0) sink.own(tangent(at, state, w));
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const;
  /// Energy lost between two states on one mesh [J]: the mean force over the way, less the energy stored in
  /// the stick.
  double loss(const MeshedBeams<D>& at, const State& from, const State& to) const;
  /// Sets the friction memory of the rider after a step that ends in `state`.
  void commit(const MeshedBeams<D>& at, const State& state, Eigen::VectorXd& memory) const;

 private:
  enum class Carrier { node, point, guide };
  // Upper bound of the coordinates: an element, the place and the multipliers.
  static constexpr int most_dofs = element_size<D> + 1 + D;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_dofs, most_dofs>;
  // Slopes r_s on both sides, with their derivatives.
  struct Slopes {
    Eigen::Vector3d left, right, by_place;  // by_place: of both slopes, where the place moves over the curve
    Eigen::Matrix<double, D, element_size<D>> by_element;  // of both slopes, at a point of an element
  };
  Slopes slopes(const MeshedBeams<D>& at, const State& state) const;
  FrictionForce force_of(const MeshedBeams<D>& at, const Slopes& slopes, const State& state) const;
  Matrix tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w) const;
  // Energy in the stick. A body that slides stores none: the spring is stretched up to the bound, and its
  // energy does not come back.
  double stored(const FrictionMemory& memory) const {
    return memory.slides == 0 ? body_.stiffness * memory.z * memory.z / 2 : 0;
  }

  FrictionOfBody body_;
  int rider_, multiplier_, place_;
  Carrier carrier_;
  int element_ = -1, segment_ = -1;         // element of a point, segment of a guide
  int slope_left_ = -1, slope_right_ = -1;  // slope coordinates of a node
  std::vector<int> dofs_;
};

extern template class SlidingFriction<2>;
extern template class SlidingFriction<3>;

}  // namespace nurbeam
