#pragma once
#include "fem/forces/energy.h"
#include "fem/forces/force_offers.h"
#include "fem/forces/turned_ends.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// A RotationalConnector in one mesh.
template <int D>
class RotationalSpring {
 public:
  static constexpr ForceOffers offers{
      .force = true, .energy = true, .loss = true, .memory = true, .damper = true, .rotational = true};
  RotationalSpring(int number, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn)
      : number_(number), ends_(at.structure.rotational_connectors[number], at, drawn) {}

  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const auto& all = binding.at.structure.rotational_connectors;
    for (int i = 0; i < static_cast<int>(all.size()); ++i)
      add(RotationalSpring(i, binding.at, binding.drawn));
  }

  const std::vector<int>& dofs() const { return ends_.dofs(); }
  /// Number among the rotational connectors of the model.
  int rotational_connector() const { return number_; }
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.stiffness != 0 || w.damping != 0) sink.own(tangent(at, state, w));
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const;
  /// Energy that damping takes between two states [J]: the mean moment over the turn.
  double loss(const MeshedBeams<D>& at, const State& from, const State& to) const;
  /// The angle is counted on from where it was after the last step.
  void commit(const MeshedBeams<D>& at, const State& state, Eigen::VectorXd& memory) const;
  bool is_damper(const MeshedBeams<D>& at) const { return described(at).damping > 0; }

  /// Angle [rad], and moment about the axis on the first end [N m]; without an axis the magnitudes.
  std::pair<double, double> angle_and_moment(const MeshedBeams<D>& at, const State& state) const;
  /// Without an axis: whether the ends are turned by less than 170 degrees.
  bool admissible(const State& state) const;

 private:
  using Ends = TurnedEnds<D>;
  const RotationalConnector& described(const MeshedBeams<D>& at) const {
    return at.structure.rotational_connectors[number_];
  }
  double counted(const MeshedBeams<D>& at, const EndAngle<D>& angle, const State& state) const;
  typename Ends::Vector forces(const MeshedBeams<D>& at, const State& state) const;
  typename Ends::Matrix tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w) const;

  int number_;
  Ends ends_;
};

extern template class RotationalSpring<2>;
extern template class RotationalSpring<3>;

}  // namespace nurbeam
