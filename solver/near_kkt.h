#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solver/second_order_system.h"

namespace nurbeam {

/// Unknowns in levels, by over how many others they are coupled with the first ones: what is in a level is
/// coupled with that, with the one before and with the one after alone. A multiplier is in the last level of
/// the coordinates that its constraint holds.
struct CouplingLevels {
  std::vector<int> unknowns;  ///< one level after the other, each in order
  std::vector<int> starts;    ///< of the levels among them, and the end

  /// `pattern`: symmetric, of so many coordinates and then multipliers; `most`: levels.
  CouplingLevels(const SparsePattern& pattern, int coordinates, const std::vector<int>& first, int most);
  int count() const { return static_cast<int>(starts.size()) - 1; }
};

enum class Beyond {
  closed,  ///< the rows next to the unknowns that are solved for must stay closed, to round-off
  given    ///< what x holds beyond is given, whatever it leaves open there
};

/// [M + (h/2) D + (h^2/4) K, G'; G 0] in the rows near some unknowns alone. Levels are eliminated from
/// outside in, so that another matrix near the first ones leaves the factors of the others as they are.
class NearKkt {
 public:
  /// The unknowns that are solved for: those coupled with `around` over at most so many others.
  NearKkt(const SecondOrderSystem& system, const std::vector<int>& around, int reach);

  /// These, in order.
  std::vector<int> unknowns() const;

  /// Takes the matrix of a state, from which the next one with the same h may differ in q alone; whether it
  /// can be eliminated so.
  [[nodiscard]] bool factorise(const State& state, double h);

  /// Corrects x and y near there until M x + G'y = top (n), G x = bottom (m) to round-off. Returns false, and
  /// nothing has changed, where that cannot be. Precondition: factorise() returned true.
  [[nodiscard]] bool correct(const Eigen::VectorXd& top, const Eigen::VectorXd& bottom, Beyond beyond,
                             Eigen::VectorXd& x, Eigen::VectorXd& y) const;

 private:
  // The rows and columns of a level and of the one before it, the first eliminated.
  using Front = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  // Where the entries of a column begin: among the values of the pattern and among the places of their rows.
  struct Entries {
    int value, row;
  };

  int start(int level) const { return levels_.starts[level]; }
  int size(int level) const { return start(level + 1) - start(level); }
  int renewed_levels(const State& state) const;
  void read(const State& state, double h, int levels);
  bool eliminate(int level);
  void solve(Eigen::VectorXd& rows) const;
  Eigen::VectorXd open_rows(const Eigen::VectorXd& right, const Eigen::VectorXd& left) const;
  Eigen::VectorXd round_off(const Eigen::VectorXd& right, const Eigen::VectorXd& left) const;
  // Calls visit(place of its row, index of its value) for each entry in the column at a place.
  template <class Visit>
  void for_each_entry(int k, const Visit& visit) const {
    const int begin = entries_[k].row, end = entries_[k + 1].row, ahead = entries_[k].value - begin;
    for (int e = begin; e < end; ++e) visit(row_places_[e], e + ahead);
  }

  const SecondOrderSystem& system_;
  const SparsePattern& pattern_;
  int n_;
  CouplingLevels levels_;  // those that are solved for and two more
  int inner_, rows_;       // how many of them are solved for, and have rows that are known
  // Columns of their unknowns, and the end; the place of a row among theirs, one behind them all where it has
  // none.
  std::vector<Entries> entries_;
  std::vector<int> row_places_;
  Eigen::VectorXd q_;  // of the matrix; empty: there is none
  std::unique_ptr<double[]> values_;
  std::vector<Front> fronts_;
};

}  // namespace nurbeam
