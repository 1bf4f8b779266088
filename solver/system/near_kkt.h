#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/algebra/fronts.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// [M + (h/2) D + (h^2/4) K, G'; G 0] in the rows near some unknowns alone. Levels are eliminated from
/// outside in. A matrix that differs only near the first unknowns then keeps the factors of the other levels.
class NearKkt {
 public:
  /// Chooses the unknowns that are solved for: those coupled with `around` over at most `reach` couplings.
  NearKkt(const SecondOrderSystem& system, const std::vector<int>& around, int reach);

  /// The unknowns that are solved for, in order.
  std::vector<int> unknowns() const;
  /// Per unknown: whether its row is known, as of unknowns that are solved for and of the next level.
  std::vector<bool> rows() const;
  int reach() const { return reach_; }

  /// Takes and factorises the matrix of a state. The next state with the same h may differ in q alone.
  /// Returns whether the elimination succeeds.
  [[nodiscard]] bool factorise(const State& state, double h);

  /// Corrects x and y near there until M x + G'y = top (n), G x = bottom (m) to round-off. The rows next to
  /// the unknowns that are solved for must stay closed, to 4e-13 of the largest. Returns false, with x and y
  /// unchanged, where that is not possible. Precondition: factorise() returned true.
  [[nodiscard]] bool correct(const Eigen::VectorXd& top, const Eigen::VectorXd& bottom, Eigen::VectorXd& x,
                             Eigen::VectorXd& y) const;
  /// Corrects x and y near there for open rows, top (n) and bottom (m), to round-off. The rows next to the
  /// unknowns must stay as open as they are, to 1e-4 of the largest or to 1e-6 of the forces in balance
  /// there. Returns as correct(), with its precondition.
  [[nodiscard]] bool answer(const Eigen::VectorXd& top, const Eigen::VectorXd& bottom, Eigen::VectorXd& x,
                            Eigen::VectorXd& y) const;

 private:
  // Columns of one front that follow one another, with entries in the same rows.
  struct Columns {
    int first, count;   // numbers of their unknowns
    int place;          // place of the first one
    int entries, rows;  // start of the first one's entries in entries_, and their number
  };

  int start(int level) const { return fronts_.start(level); }
  int levels() const { return fronts_.level_count(); }
  void list_entries();
  int renewed_levels(const State& state) const;
  void read(const State& state, double h, int levels);
  void take(const double* values, int levels);
  bool eliminate(int level);
  void solve(Eigen::VectorXd& rows) const;
  Eigen::ArrayXd faded(const Eigen::VectorXd& open, const Eigen::VectorXd& present,
                       const Eigen::VectorXd& correction) const;
  bool correct(const Eigen::VectorXd& right, const Eigen::ArrayXd& enough, Eigen::VectorXd& left) const;
  Eigen::VectorXd near_part(const Eigen::VectorXd& top, const Eigen::VectorXd& bottom) const;
  void put_back(const Eigen::VectorXd& part, Eigen::VectorXd& top, Eigen::VectorXd& bottom) const;
  Eigen::VectorXd open_rows(const Eigen::VectorXd& right, const Eigen::VectorXd& left) const;
  Eigen::VectorXd round_off(const Eigen::VectorXd& right, const Eigen::VectorXd& left) const;
  double largest_coordinate(const Eigen::VectorXd& of) const;
  bool is_coordinate(int place) const { return fronts_.unknowns()[place] < n_; }

  const SecondOrderSystem& system_;
  const SparsePattern& pattern_;
  int n_, reach_;
  Fronts fronts_;     // fronts that are solved for, and two more levels
  int inner_, rows_;  // number of levels that are solved for, and of levels with known rows
  std::vector<Columns> columns_;
  std::vector<int> entries_;  // index of each entry in the blocks; -1: in rows beyond
  Eigen::VectorXd q_;         // q of the matrix; empty: there is none
  Eigen::VectorXd blocks_, factors_;
  Eigen::VectorXd row_sizes_;  // largest entry of each row of a constraint, 0 for other rows
};

}  // namespace nurbeam
