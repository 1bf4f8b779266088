#pragma once
#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// By what the residuals of pairs of neighbouring systems of one mesh differ at the same state. Elements that
/// are the same in both, as those out of reach of a control point that moves, are left out; those of all
/// pairs that are left are evaluated side by side.
class ResidualDifferences {
 public:
  /// Two systems, of a parameter that is `step` greater and less.
  struct Pair {
    const BeamSystem *more, *less;
    double step;
  };
  /// `near`: any state that all can have. The systems must outlive it.
  ResidualDifferences(const std::vector<Pair>& pairs, const State& near);
  /// Behind a change of the mesh, to that of `system`: those of pairs that outlast it are what they were, and
  /// their systems those of the mesh before. `elements`: as below.
  ResidualDifferences(const std::vector<Pair>& pairs, const State& near, const ResidualDifferences& before,
                      const std::vector<bool>& outlasting, const BeamSystem& system,
                      const std::vector<int>& elements);
  ~ResidualDifferences();
  ResidualDifferences(ResidualDifferences&&) noexcept;
  ResidualDifferences& operator=(ResidualDifferences&&) noexcept;

  /// A coordinate, and by how much it changes with the parameter.
  using Shift = std::pair<int, double>;
  /// Of vectors, a column for each pair.
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Half the difference over `step` for each pair: more at a time step x `later` after that of `at`, and
  /// with coordinates that are shifted so far; less as much before it, and as far the other way. Into
  /// `dynamics` (n rows) and `constraints` (m rows), always the same two: of those without shifts as the call
  /// before has left them. `system`: that of `at`; laws with a kink are on the side on which they are there,
  /// as its tangents have it: numbers of elements that change at the same coordinates strain them by more
  /// than what carries.
  void find(const BeamSystem& system, const State& at, const Eigen::RowVectorXd& later,
            const std::vector<std::vector<Shift>>& shifts, Columns& dynamics, Columns& constraints);

  /// For sums of residuals times multipliers back over steps of a system, as many as these have columns: from
  /// here on `find` leaves columns of pairs zero that differ in nothing but numbers of elements, and what
  /// they do to the sums is told by add and sums. `at`: any state; `shifts`: as find has them.
  void go_back(const BeamSystem& system, const State& at, const std::vector<std::vector<Shift>>& shifts,
               Eigen::Index sums);
  /// Whether find leaves all columns zero.
  bool are_all_in_sums() const;
  /// Adds the residual at a state times multipliers (n + m, sums), after find there.
  void add(const State& at, const Columns& multipliers);
  /// (sums, pairs) How the sums so far change with the parameters, but for what find has told.
  Columns sums() const;

  /// Which pairs outlast a change of the mesh: at a state, and coordinates so far shifted, nothing differs in
  /// them but elements with fixed ends that are behind the change what they are before it. `elements`: by the
  /// index of an element before the change the one behind it, -1 where it is gone.
  std::vector<bool> outlast(const State& at, const std::vector<std::vector<Shift>>& shifts,
                            const std::vector<int>& elements);

  /// (coordinates, pairs) How the momentum of these velocities changes in the elements of pairs that outlast
  /// the last change, of other pairs zero.
  Columns momenta(const Eigen::VectorXd& velocities) const;
  /// How the mechanical energy of a state changes in the elements of all pairs.
  Eigen::RowVectorXd energies(const State& at) const;

  /// The residuals of whole systems whose elements find and add evaluate, where the same loads act in both of
  /// a pair.
  double work() const;

 private:
  struct Implementation;
  template <int D>
  struct In;

  std::unique_ptr<Implementation> in_;
};

}  // namespace nurbeam
