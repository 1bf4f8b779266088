#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/remesh/meshed_state.h"
#include "fem/system/momentum.h"
#include "solver/tangents/step_tangent.h"

namespace nurbeam {

/// A transfer to another mesh (projected), linearised where it has been. With the equations that each of its
/// stages solves, of velocities v and impulse y, and of a move d with its multipliers nu and mu,
///   M v + G'y = p,  G v + rate = 0;   (K + mu M) d + g + G'nu = 0,  G d = 0,  g d + d K d / 2 + e = 0,
/// its tangents are solutions with the same matrices. On the right are changes of M v + G'y, which are those
/// of a residual at accelerations so large that forces are lost beside them, and of K d, which are those of
/// (F(q + e d) - F(q - e d)) / 2e, e small: for all parameters at once, by tangents of the run itself and by
/// differences of residuals of neighbours. Momentum p, energy e and what is interpolated change as those of
/// neighbours do, and so do velocities that keep the energy.
class TransferTangent {
 public:
  using Matrix = MotionTangents::Matrix;

  /// Of one parameter that is greater and less by `step`: on the mesh before, and the meshes behind. They lie
  /// beside the run's own systems where these are theirs.
  struct Neighbours {
    MeshedState more_before, less_before;
    std::shared_ptr<const BeamSystem> more, less;
    double step = 0;
  };
  /// (n, a column for each parameter) how the dynamics of `system` change at a state with the parameter
  /// itself, with t, and in these rows by these tangents of q.
  using ResidualChanges =
      std::function<Matrix(const State& at, const Matrix& q, const std::vector<int>& rows)>;

  /// What neighbours lack that lie beside the run's own systems, by their elements that are there before and
  /// behind.
  struct Kept {
    Matrix momenta;  ///< (n, a column for each parameter) of what is carried over
    /// (a column for each parameter) Of what a state behind has more energy than that before.
    std::function<Eigen::RowVectorXd(const State& behind)> energies;
  };

  TransferTangent(std::shared_ptr<const BeamSystem> before, std::shared_ptr<const BeamSystem> system,
                  const TransferPath& path, std::vector<Neighbours> neighbours, Kept kept,
                  ResidualChanges residual_changes);

  /// Puts q, v, a and lambda of tangents, which have t, to what they are behind it; false where an equation
  /// is singular.
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
  std::vector<int> with_shape_;  // rows of dynamics in which inertia and constraints change with q
};

}  // namespace nurbeam
