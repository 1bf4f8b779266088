#pragma once
#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// Differences of the residuals of pairs of neighbouring systems of one mesh, at the same state. Elements
/// that are equal in both systems are left out, such as those out of reach of a control point that moves. The
/// remaining elements of all pairs are evaluated side by side.
class ResidualDifferences {
 public:
  /// Two systems, whose parameter is greater and less by `step`.
  struct Pair {
    const BeamSystem *more, *less;
    double step;
  };
  /// `near`: any state that all systems can have. The systems must outlive this object.
  ResidualDifferences(const std::vector<Pair>& pairs, const State& near);
  /// Differences after a change to the mesh of `system`. Pairs that outlast the change are taken over, and
  /// their systems keep the mesh of before. `elements`: see outlast().
  ResidualDifferences(const std::vector<Pair>& pairs, const State& near, const ResidualDifferences& before,
                      const std::vector<bool>& outlasting, const BeamSystem& system,
                      const std::vector<int>& elements);
  ~ResidualDifferences();
  ResidualDifferences(ResidualDifferences&&) noexcept;
  ResidualDifferences& operator=(ResidualDifferences&&) noexcept;

  /// A coordinate, and its derivative by the parameter.
  using Shift = std::pair<int, double>;
  /// Vectors, a column for each pair.
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Finds half the difference over `step` for each pair. The system with more is evaluated at a time step x
  /// `later` after that of `at`, with coordinates shifted by step x shift; the other one as much earlier,
  /// shifted the other way.
  ///
  /// Results go into `dynamics` (n rows) and `constraints` (m rows), which must be the same two in all calls:
  /// columns without shifts keep their zeros from the call before. `system`: the system of `at`. Laws with a
  /// kink stay on their side in `at`, as in the system's tangents: at the same coordinates, a change of an
  /// element's numbers strains it by more than the present strain.
  void find(const BeamSystem& system, const State& at, const Eigen::RowVectorXd& later,
            const std::vector<std::vector<Shift>>& shifts, Columns& dynamics, Columns& constraints);

  /// Prepares sums of residuals times multipliers, backwards over steps of a system; `sums`: number of sums.
  /// From here on `find` leaves columns zero of pairs that differ in numbers of elements alone. add and sums
  /// give their effect on the sums. `at`: any state; `shifts`: see find.
  void go_back(const BeamSystem& system, const State& at, const std::vector<std::vector<Shift>>& shifts,
               Eigen::Index sums);
  /// Whether find leaves all columns zero.
  bool are_all_in_sums() const;
  /// Adds the residual at a state times multipliers (n + m, sums); to be called after find in this state.
  void add(const State& at, const Columns& multipliers);
  /// (sums, pairs) Derivatives of the sums so far by the parameters, without the part that find has given.
  Columns sums() const;

  /// Per pair: whether it outlasts a change of the mesh. In this state, with shifted coordinates, it must
  /// then differ only in elements with fixed ends that are unchanged after the change. `elements`: new index
  /// of each element of before, -1 where it is gone.
  std::vector<bool> outlast(const State& at, const std::vector<std::vector<Shift>>& shifts,
                            const std::vector<int>& elements);

  /// (coordinates, pairs) Derivatives of the momentum of these velocities in the elements of pairs that
  /// outlast the last change; zero for other pairs.
  Columns momenta(const Eigen::VectorXd& velocities) const;
  /// Derivatives of the mechanical energy of a state in the elements of all pairs.
  Eigen::RowVectorXd energies(const State& at) const;

  /// Cost of find and add in residuals of whole systems, where equal loads act in both systems of a pair.
  double work() const;

 private:
  struct Implementation;
  template <int D>
  struct In;

  std::unique_ptr<Implementation> in_;
};

}  // namespace nurbeam
