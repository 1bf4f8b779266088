#pragma once
#include <optional>
#include <vector>

#include "fem/forces/energy.h"
#include "fem/forces/force_offers.h"
#include "fem/mesh/binding.h"
#include "fem/mesh/connector_axis.h"

namespace nurbeam {

/// Pull of a connector for a stretch e and its rate, with derivatives.
///
/// A connector that carries one sign and is not `taut` at the start of a step has no damping in that step; a
/// taut one has damping throughout. So nothing jumps within a step. `carries`: whether the stretch carries,
/// where a solver prescribes this instead of the sign of the stretch.
struct ConnectorPull {
  double force = 0;    ///< N [N]
  double elastic = 0;  ///< elastic part F(e) of N [N]
  double energy = 0;   ///< of the elastic part [J]
  double by_stretch = 0, by_rate = 0;

  ConnectorPull(const Connector& connector, double stretch, double rate, bool taut,
                std::optional<bool> carries = {});
};

/// A connector other than a rod, in one mesh.
template <int D>
class Spring {
 public:
  static constexpr ForceOffers offers{.force = true,
                                      .energy = true,
                                      .loss = true,
                                      .memory = true,
                                      .on_body = true,
                                      .damper = true,
                                      .connector = true};
  Spring(int connector, const MeshedBeams<D>& at)
      : number_(connector), axis_(at.structure.connectors[connector], at.structure, at.mesh) {}

  /// Binds all connectors other than rods.
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const std::vector<Connector>& connectors = binding.at.structure.connectors;
    for (int i = 0; i < static_cast<int>(connectors.size()); ++i)
      if (connectors[i].type != ConnectorType::rod) add(Spring(i, binding.at));
  }

  const std::vector<int>& dofs() const { return axis_.dofs(); }
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.stiffness != 0 || w.damping != 0) sink.own(tangent(at, state, w));
  }
  void add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const;

  /// Energy that damping takes between two states [J]: the mean force over the change of length.
  double loss(const MeshedBeams<D>& at, const State& from, const State& to) const;
  void commit(const MeshedBeams<D>& at, const State& state, Eigen::VectorXd& memory) const;

  bool is_damper(const MeshedBeams<D>& at) const { return described(at).damping > 0; }
  /// Number of the connector in the model.
  int connector() const { return number_; }
  /// carries_one_sign(): whether the connector's law has a kink; carries(): whether it is stretched so that
  /// it carries.
  bool carries_one_sign(const MeshedBeams<D>& at) const { return described(at).sign() != 0; }
  bool carries(const MeshedBeams<D>& at, const State& state) const;
  /// Index of the connector in State::sides.
  Eigen::Index side(const MeshedBeams<D>& at) const {
    return static_cast<Eigen::Index>(at.elements.size()) + number_;
  }
  /// Length |d| or n . d [m], and N [N].
  std::pair<double, double> length_and_force(const MeshedBeams<D>& at, const State& state) const;
  /// The force on a body [N].
  Eigen::Matrix<double, D, 1> on_body(const MeshedBeams<D>& at, int body, const State& state) const;

 private:
  using Matrix = Eigen::Matrix<double, 2 * D, 2 * D>;
  using Line = typename ConnectorAxis<D>::Line;
  Matrix tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w) const;
  ConnectorPull pull(const MeshedBeams<D>& at, const Line& line, const State& state) const;
  const Connector& described(const MeshedBeams<D>& at) const { return at.structure.connectors[number_]; }

  int number_;
  ConnectorAxis<D> axis_;
};

extern template class Spring<2>;
extern template class Spring<3>;

}  // namespace nurbeam
