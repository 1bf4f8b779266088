#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/remesh/meshed_state.h"
#include "fem/system/momentum.h"
#include "solver/tangents/step_tangent.h"

namespace nurbeam {

/// A transfer to another mesh (projected), linearised. Its stages solve equations of velocities v and impulse
/// y, and of a move d with multipliers nu and mu:
///   M v + G'y = p,  G v + rate = 0;   (K + mu M) d + g + G'nu = 0,  G d = 0,  g d + d K d / 2 + e = 0.
/// Tangents are solutions with the same matrices. On the right are two changes. That of M v + G'y is the
/// change of a residual at accelerations so large that forces are lost beside them. That of K d is the change
/// of (F(q + e d) - F(q - e d)) / 2e, e small. Both are found for all parameters at once, by tangents of the
/// run itself and by differences of residuals of neighbours. Momentum p, energy e and interpolated values
/// change as they do for neighbours, and so do velocities that conserve the energy.
class TransferTangent {
 public:
  using Matrix = MotionTangents::Matrix;

  /// The neighbours of one parameter, which is greater and less by `step`: on the mesh before, and the meshes
  /// after. Neighbours that lag use the run's own systems.
  struct Neighbours {
    MeshedState more_before, less_before;
    std::shared_ptr<const BeamSystem> more, less;
    double step = 0;
  };
  /// (n, a column for each parameter) Change of the dynamics of `system` in a state: with the parameter
  /// itself, with t, and in these rows by these tangents of q.
  using ResidualChanges =
      std::function<Matrix(const State& at, const Matrix& q, const std::vector<int>& rows)>;

  /// The part that is missing in neighbours on the run's own systems: that of their elements, which are there
  /// before and after.
  struct Kept {
    Matrix momenta;  ///< (n, a column for each parameter) of the motion that is carried over
    /// (a column for each parameter) Change of the excess of energy of a state after the transfer over the
    /// state before.
    std::function<Eigen::RowVectorXd(const State& behind)> energies;
  };

  TransferTangent(std::shared_ptr<const BeamSystem> before, std::shared_ptr<const BeamSystem> system,
                  const TransferPath& path, std::vector<Neighbours> neighbours, Kept kept,
                  ResidualChanges residual_changes);

  /// Carries q, v, a and lambda of tangents, whose t is set, over the transfer; false where an equation is
  /// singular.
  [[nodiscard]] bool carry(MotionTangents& tangents) const;

 private:
  struct Momenta {
    std::optional<CarriedMomentum> more, less;
  };

  template <class Work>
  void for_each_parameter(const Work& work) const;
  template <class Of>
  Matrix rates(Eigen::Index rows, const Of& of) const;
  bool is_own(std::size_t parameter) const { return neighbours_[parameter].more == system_; }
  void interpolate(MotionTangents& tangents) const;
  void put_bodies(const State& at, MotionTangents& tangents) const;
  bool find_velocities(const Transferred& stage, MotionTangents& tangents) const;
  Matrix energies(const State& at, const MotionTangents& tangents) const;
  void keep_energy(const State& at, double excess, MotionTangents& tangents) const;
  bool move(const Transferred& stage, const MadeMove& made, MotionTangents& tangents) const;

  std::shared_ptr<const BeamSystem> before_, system_;
  const TransferPath& path_;
  std::vector<Neighbours> neighbours_;
  std::vector<Momenta> momenta_;
  Kept kept_;
  ResidualChanges residual_changes_;
  std::vector<int> with_shape_;  // rows of dynamics whose inertia and constraints change with q
};

}  // namespace nurbeam
