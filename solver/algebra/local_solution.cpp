#include "solver/algebra/local_solution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/algebra/kkt_solver.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using View = Eigen::Map<const Matrix>;

View view(const SparseView& A) {
  return {A.rows(), A.cols(), A.nonZeros(), A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr()};
}

// The residual b - A x, and its round-off.
struct Open {
  Eigen::VectorXd rows, round_off;

  Open(const View& A, const Eigen::VectorXd& b, const Eigen::VectorXd& x) : rows(b), round_off(b.cwiseAbs()) {
    for (int column = 0; column < A.cols(); ++column) take(A, x, column);
    round_off *= 32 * std::numeric_limits<double>::epsilon();
  }
  bool at(Eigen::Index row) const { return !(std::abs(rows[row]) <= round_off[row]); }

 private:
  void take(const View& A, const Eigen::VectorXd& x, int column) {
    if (x[column] == 0) return;
    for (View::InnerIterator entry(A, column); entry; ++entry) {
      const double product = entry.value() * x[column];
      rows[entry.row()] -= product;
      round_off[entry.row()] += std::abs(product);
    }
  }
};

// Adds the unknowns that are coupled with the last level, from `begin` on, and have no place yet. Returns
// where the new ones begin.
std::size_t append_coupled(const int* starts, const int* rows, std::size_t begin, std::vector<int>& unknowns,
                           std::vector<int>& place) {
  const std::size_t end = unknowns.size();
  for (; begin < end; ++begin)
    for (int k = starts[unknowns[begin]]; k < starts[unknowns[begin] + 1]; ++k)
      if (std::exchange(place[rows[k]], 0) < 0) unknowns.push_back(rows[k]);
  return end;
}

// The rows and columns of some unknowns; `place`: index of each unknown among them, -1: none.
Matrix part_of(const View& A, const std::vector<int>& unknowns, const std::vector<int>& place) {
  const auto size = static_cast<Eigen::Index>(unknowns.size());
  Matrix own(size, size);
  Eigen::Index entries = 0;
  for (const int unknown : unknowns) entries += A.outerIndexPtr()[unknown + 1] - A.outerIndexPtr()[unknown];
  own.reserve(entries);
  for (Eigen::Index k = 0; k < size; ++k) {
    own.startVec(k);
    for (View::InnerIterator entry(A, unknowns[k]); entry; ++entry)
      if (place[entry.row()] >= 0) own.insertBack(place[entry.row()], k) = entry.value();
  }
  own.finalize();
  return own;
}

// A window of some unknowns, with the matrix of their rows and columns.
class Window {
 public:
  /// A window of the open unknowns and those coupled with them over at most `reach` couplings.
  Window(const View& A, const Open& open, int reach) : place_(static_cast<std::size_t>(A.cols()), -1) {
    for (int i = 0; i < A.cols(); ++i)
      if (open.at(i)) {
        place_[i] = 0;
        unknowns_.push_back(i);
      }
    for (std::size_t begin = 0; reach > 0 && begin < unknowns_.size(); --reach)
      begin = append_coupled(A.outerIndexPtr(), A.innerIndexPtr(), begin, unknowns_, place_);
    number();
  }

  int size() const { return static_cast<int>(unknowns_.size()); }
  Eigen::VectorXd part(const Eigen::VectorXd& all) const { return all(unknowns_); }
  void add(const Eigen::VectorXd& part, Eigen::VectorXd& all) const { all(unknowns_) += part; }

  Matrix matrix(const View& A) const { return part_of(A, unknowns_, place_); }

  /// Whether the solution in the window leaves the rows beyond it closed, to the round-off of what it
  /// changes.
  bool suffices(const View& A, const Open& open, const Eigen::VectorXd& solution) const {
    Eigen::VectorXd left = open.rows;
    double largest = 0;
    for (int k = 0; k < size(); ++k)
      for (View::InnerIterator entry(A, unknowns_[k]); entry; ++entry) {
        const double product = entry.value() * solution[k];
        left[entry.row()] -= product;
        largest = std::max(largest, std::abs(product));
      }
    const double moved = 4 * std::numeric_limits<double>::epsilon() * largest;
    for (const int unknown : unknowns_)
      for (View::InnerIterator entry(A, unknown); entry; ++entry)
        if (place_[entry.row()] < 0 &&
            !(std::abs(left[entry.row()]) <= std::max(open.round_off[entry.row()], moved)))
          return false;
    return true;
  }

 private:
  void number() {
    std::sort(unknowns_.begin(), unknowns_.end());
    for (std::size_t k = 0; k < unknowns_.size(); ++k) place_[unknowns_[k]] = static_cast<int>(k);
  }

  std::vector<int> unknowns_, place_;  // place_: index of each unknown in the window, -1: none
};

}  // namespace

Matrix submatrix(const SparseView& A, const std::vector<int>& unknowns) {
  std::vector<int> place(static_cast<std::size_t>(A.cols()), -1);
  for (std::size_t k = 0; k < unknowns.size(); ++k) place[unknowns[k]] = static_cast<int>(k);
  return part_of(view(A), unknowns, place);
}

bool correct_locally(const SparseView& matrix, const Eigen::VectorXd& b, const std::vector<int>& last,
                     Eigen::VectorXd& x) {
  constexpr int first_reach = 40, growth = 3;
  const View A = view(matrix);
  const Open open(A, b, x);
  KktSolver solver;
  for (int reach = first_reach, last_size = 0;; reach *= growth) {
    const Window window(A, open, reach);
    if (window.size() == 0) return true;
    if (window.size() == last_size || 2 * window.size() > A.cols()) break;
    last_size = window.size();
    if (!solver.factorise(window.matrix(A))) continue;  // the window has cut a constraint
    const Eigen::VectorXd solution = solver.solve(window.part(open.rows));
    if (!solution.allFinite() || !window.suffices(A, open, solution)) continue;
    window.add(solution, x);
    return true;
  }
  if (!solver.factorise(matrix, last)) return false;
  const Eigen::VectorXd correction = solver.solve(open.rows);
  if (!correction.allFinite()) return false;
  x += correction;
  return true;
}

}  // namespace nurbeam
