#include "solver/local_solution.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/kkt_solver.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

// b - A x, and what of it is round-off.
struct Open {
  Eigen::VectorXd rows, round_off;

  Open(const Matrix& A, const Eigen::VectorXd& b, const Eigen::VectorXd& x)
      : rows(b), round_off(b.cwiseAbs()) {
    for (int column = 0; column < A.cols(); ++column) {
      if (x[column] == 0) continue;
      for (Matrix::InnerIterator entry(A, column); entry; ++entry) {
        const double product = entry.value() * x[column];
        rows[entry.row()] -= product;
        round_off[entry.row()] += std::abs(product);
      }
    }
    round_off *= 32 * std::numeric_limits<double>::epsilon();
  }
  bool at(Eigen::Index row) const { return !(std::abs(rows[row]) <= round_off[row]); }
};

// Some of the unknowns, and the matrix of their rows and columns.
class Window {
 public:
  /// What is open, and what is coupled with it over so many others.
  Window(const Matrix& A, const Open& open, int reach) : place_(static_cast<std::size_t>(A.cols()), -1) {
    for (int i = 0; i < A.cols(); ++i)
      if (open.at(i)) take(i);
    for (std::size_t begin = 0; reach > 0 && begin < unknowns_.size(); --reach) {
      const std::size_t end = unknowns_.size();
      for (; begin < end; ++begin)
        for (Matrix::InnerIterator entry(A, unknowns_[begin]); entry; ++entry)
          if (place_[entry.row()] < 0) take(static_cast<int>(entry.row()));
    }
    std::sort(unknowns_.begin(), unknowns_.end());
    for (std::size_t k = 0; k < unknowns_.size(); ++k) place_[unknowns_[k]] = static_cast<int>(k);
  }

  int size() const { return static_cast<int>(unknowns_.size()); }
  Eigen::VectorXd part(const Eigen::VectorXd& all) const { return all(unknowns_); }
  void add(const Eigen::VectorXd& part, Eigen::VectorXd& all) const { all(unknowns_) += part; }

  Matrix matrix(const Matrix& A) const {
    Matrix own(size(), size());
    for (int k = 0; k < size(); ++k) {
      own.startVec(k);
      for (Matrix::InnerIterator entry(A, unknowns_[k]); entry; ++entry)
        if (place_[entry.row()] >= 0) own.insertBack(place_[entry.row()], k) = entry.value();
    }
    own.finalize();
    return own;
  }

  /// Whether the solution for it leaves the rows beyond it closed.
  bool suffices(const Matrix& A, const Open& open, const Eigen::VectorXd& solution) const {
    Eigen::VectorXd left = Eigen::VectorXd::Zero(A.rows());
    std::vector<int> touched;
    for (int k = 0; k < size(); ++k)
      for (Matrix::InnerIterator entry(A, unknowns_[k]); entry; ++entry)
        if (place_[entry.row()] < 0) {
          left[entry.row()] -= entry.value() * solution[k];
          touched.push_back(static_cast<int>(entry.row()));
        }
    return std::all_of(touched.begin(), touched.end(),
                       [&](int row) { return std::abs(open.rows[row] + left[row]) <= open.round_off[row]; });
  }

 private:
  void take(int unknown) {
    place_[unknown] = 0;
    unknowns_.push_back(unknown);
  }

  std::vector<int> unknowns_, place_;  // where each is among them, -1: it is not
};

}  // namespace

bool correct_locally(const Matrix& A, const Eigen::VectorXd& b, const std::vector<int>& last,
                     Eigen::VectorXd& x) {
  constexpr int first_reach = 40, growth = 3;
  const Open open(A, b, x);
  KktSolver solver;
  for (int reach = first_reach;; reach *= growth) {
    const Window window(A, open, reach);
    if (window.size() == 0) return true;
    if (2 * window.size() > A.cols()) break;
    if (!solver.factorise(window.matrix(A))) continue;  // it has cut a constraint
    const Eigen::VectorXd solution = solver.solve(window.part(open.rows));
    if (!solution.allFinite() || !window.suffices(A, open, solution)) continue;
    window.add(solution, x);
    return true;
  }
  if (!solver.factorise(A, last)) return false;
  const Eigen::VectorXd correction = solver.solve(open.rows);
  if (!correction.allFinite()) return false;
  x += correction;
  return true;
}

}  // namespace nurbeam
