#include "solver/algebra/kkt_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "solver/algebra/finite.h"
#include "solver/algebra/side_by_side.h"
#include "solver/algebra/strand.h"

namespace nurbeam {

namespace {

// A cut of an order, from place `end` to place `begin`: the places before and behind it are coupled through
// it alone.
struct Cut {
  int end, begin;
};

// The narrowest cut near the middle of an order.
Cut cut_of(const BandOrder& order) {
  constexpr double middle = 0.45;  // the search goes from here to as far before the end
  const int size = static_cast<int>(order.unknown.size());
  const int first = static_cast<int>(middle * size);
  int reached = 0;
  for (int k = 0; k < first; ++k) reached = std::max(reached, order.ends[k]);
  Cut best{first, size};
  for (int end = first; end < size - first; ++end) {
    const int begin = std::max(reached, end);
    if (begin - end < best.begin - best.end) best = {end, begin};
    reached = std::max(reached, order.ends[end]);
  }
  return best;
}

// The pattern of a matrix as runs of rows, kept once for columns that follow one another with the same rows.
// For a chain this takes a thirtieth of the room of its indices.
class PatternInRuns {
 public:
  explicit PatternInRuns(const SparseView& matrix) : size_(matrix.cols()) {
    for (int column = 0; column < matrix.cols(); ++column) add(matrix, column);
    columns_.shrink_to_fit();
    runs_.shrink_to_fit();
  }

  bool is_of(const SparseView& matrix) const {
    if (matrix.cols() != size_) return false;
    const int *end = matrix.outerIndexPtr(), *row = matrix.innerIndexPtr();
    auto first = runs_.begin();
    for (const auto& [count, runs, entries] : columns_) {
      const auto last = first + runs;
      for (int column = 0; column < count; ++column, ++end) {
        if (end[1] - end[0] != entries) return false;
        // The rows of a column increase: a run is there if its first and last rows are.
        for (auto run = first; run != last; row += run->count, ++run)
          if (row[0] != run->first || row[run->count - 1] != run->first + run->count - 1) return false;
      }
      first = last;
    }
    return true;
  }

 private:
  struct Run {
    int first, count;
  };
  struct Columns {
    int count, runs, entries;
  };

  void add(const SparseView& matrix, int column) {
    if (column > 0 && have_same_rows(matrix, column - 1, column)) {
      ++columns_.back().count;
      return;
    }
    const int begin = matrix.outerIndexPtr()[column], end = matrix.outerIndexPtr()[column + 1];
    const int* rows = matrix.innerIndexPtr();
    const int before = static_cast<int>(runs_.size());
    for (int k = begin; k < end;) {
      const int first = k++;
      while (k < end && rows[k] == rows[k - 1] + 1) ++k;
      runs_.push_back({rows[first], k - first});
    }
    columns_.push_back({1, static_cast<int>(runs_.size()) - before, end - begin});
  }

  Eigen::Index size_;
  std::vector<Columns> columns_;
  std::vector<Run> runs_;
};

// An analysed pattern: the positions of entries, the part that is eliminated last, with the cut between
// strands, and the orders of the strands.
struct AnalysedPattern {
  // An entry of S.
  struct Entry {
    int value, row, column;  // index among the matrix's values; place in S
  };

  PatternInRuns entries;
  std::vector<int> last, part;
  bool is_cut = false;
  std::vector<std::shared_ptr<const StrandOrder>> strands;
  std::vector<Entry> within;

  // `may_cut`: whether a long strand may become two.
  AnalysedPattern(const SparseView& matrix, const std::vector<int>& eliminated_last, bool may_cut)
      : entries(matrix), last(eliminated_last), part(eliminated_last) {
    BandOrder whole(matrix, last);
    is_cut = may_cut && is_worth_two(whole);
    if (is_cut)
      cut(matrix, whole);
    else
      add_strand(matrix, std::move(whole), places_in_part(matrix));
    if (part.empty()) return;
    const std::vector<int> in_part = places_in_part(matrix);
    const int *starts = matrix.outerIndexPtr(), *rows = matrix.innerIndexPtr();
    for (int column = 0; column < matrix.cols(); ++column)
      for (int k = starts[column]; in_part[column] >= 0 && k < starts[column + 1]; ++k)
        if (in_part[rows[k]] >= 0) within.push_back({k, in_part[rows[k]], in_part[column]});
  }

  bool is_of(const SparseView& matrix, const std::vector<int>& eliminated_last) const {
    return last == eliminated_last && entries.is_of(matrix);
  }

 private:
  // Whether two strands side by side take less time than one.
  static bool is_worth_two(const BandOrder& whole) {
    constexpr std::size_t fewest_unknowns = 8000;
    constexpr int widest_cut = 24;
    if (whole.unknown.size() < fewest_unknowns) return false;
    const Cut middle = cut_of(whole);
    return middle.begin - middle.end <= widest_cut;
  }

  std::vector<int> places_in_part(const SparseView& matrix) const {
    std::vector<int> places(static_cast<std::size_t>(matrix.cols()), -1);
    for (std::size_t j = 0; j < part.size(); ++j) places[part[j]] = static_cast<int>(j);
    return places;
  }

  void add_strand(const SparseView& matrix, BandOrder order, const std::vector<int>& in_part) {
    strands.push_back(std::make_shared<const StrandOrder>(matrix, std::move(order), in_part));
  }

  void cut(const SparseView& matrix, const BandOrder& whole) {
    const auto [end, begin] = cut_of(whole);
    const auto start = whole.unknown.begin();
    part.insert(part.end(), start + end, start + begin);
    const std::vector<int> in_part = places_in_part(matrix);
    std::vector<int> rest(start + begin, whole.unknown.end());
    // The cut is coupled with the end of the first strand. It is also coupled with the end of the second
    // strand, once this is reversed up to the end of its component.
    if (begin > end && last.empty()) {
      int component = begin;
      for (int reached = begin; component < reached || component == begin; ++component)
        reached = std::max(reached, whole.ends[component]);
      std::reverse(rest.begin(), rest.begin() + (component - begin));
    }
    add_strand(matrix, BandOrder::of(matrix, {start, start + end}), in_part);
    add_strand(matrix, BandOrder::of(matrix, std::move(rest)), in_part);
  }
};

}  // namespace

struct KktSolver::Implementation {
  std::shared_ptr<const AnalysedPattern> pattern;
  std::vector<Strand> strands;
  Eigen::MatrixXd schur;   // S - W V as factorised
  Eigen::MatrixXd corner;  // S - W V with later changes, row-scaled
  Eigen::VectorXd corner_scale;
  Eigen::PartialPivLU<Eigen::MatrixXd> corner_lu;
  Eigen::VectorXd rest, part;

  void analyse(const SparseView& matrix, const std::vector<int>& last, bool may_cut) {
    // Several solvers work on matrices of one mesh: the pattern analysed last is at hand.
    thread_local std::shared_ptr<const AnalysedPattern> found;
    if (!found || !found->is_of(matrix, last) || (found->is_cut && !may_cut))
      found = std::make_shared<AnalysedPattern>(matrix, last, may_cut);
    pattern = found;
    strands.clear();
    for (const auto& order : pattern->strands) strands.emplace_back(order, matrix);
  }

  template <class Work>
  void for_each_strand(const Work& work) {
    if (strands.size() == 1) return work(strands.front());
    side_by_side(static_cast<int>(strands.size()), [&](int i) { work(strands[i]); });
  }

  // Factorises all strands and the corner; returns whether they are regular.
  bool factorise(const SparseView& matrix) {
    bool is_regular[2] = {true, true};
    for_each_strand([&](Strand& strand) {
      is_regular[&strand - strands.data()] = strand.factorise(matrix, pattern->part.size());
    });
    if (!is_regular[0] || !is_regular[1]) return false;
    if (pattern->part.empty()) return true;
    const auto p = static_cast<Eigen::Index>(pattern->part.size());
    schur.setZero(p, p);
    for (const auto& [value, row, column] : pattern->within) schur(row, column) += matrix.valuePtr()[value];
    for (const Strand& strand : strands) strand.take_from(schur);
    corner = schur;
    return factorise_corner();
  }

  // Factorises the corner with scaled rows; returns whether it is regular.
  bool factorise_corner() {
    if (!corner.allFinite()) return false;
    corner_scale = corner.rowwise().lpNorm<Eigen::Infinity>();
    if (!(corner_scale.minCoeff() > 0)) return false;
    corner_scale = corner_scale.cwiseInverse();
    corner.array().colwise() *= corner_scale.array();
    corner_lu.compute(corner);
    const auto pivots = corner_lu.matrixLU().diagonal().cwiseAbs();
    return pivots.minCoeff() > smallest_reciprocal_condition * pivots.maxCoeff();
  }

  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) {
    for_each_strand([&](Strand& strand) { strand.lower(rhs); });
    x.resize(rhs.size());
    part.resize(static_cast<Eigen::Index>(pattern->part.size()));
    if (!pattern->part.empty()) solve_part(rhs, x);
    for_each_strand([&](Strand& strand) { strand.upper(part, x); });
  }

  // Solves for the part of x that is eliminated last.
  void solve_part(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) {
    const auto p = static_cast<Eigen::Index>(pattern->part.size());
    rest.resize(p);
    for (Eigen::Index j = 0; j < p; ++j) {
      double beside = 0;
      for (const Strand& strand : strands) beside += strand.beside(static_cast<std::size_t>(j));
      rest[j] = corner_scale[j] * (rhs[pattern->part[j]] - beside);
    }
    part = corner_lu.solve(rest);
    for (Eigen::Index j = 0; j < p; ++j) x[pattern->part[j]] = part[j];
  }
};

KktSolver::KktSolver() : implementation_(std::make_unique<Implementation>()) {}
KktSolver::~KktSolver() = default;
KktSolver::KktSolver(KktSolver&&) noexcept = default;
KktSolver& KktSolver::operator=(KktSolver&&) noexcept = default;

bool KktSolver::factorise(const SparseView& matrix, const std::vector<int>& part) {
  assert(matrix.isCompressed() && matrix.rows() == matrix.cols());
  Implementation& self = *implementation_;
  if (!all_finite(Eigen::Map<const Eigen::ArrayXd>(matrix.valuePtr(), matrix.nonZeros()))) return false;
  if (!self.pattern || !self.pattern->is_of(matrix, part)) self.analyse(matrix, part, true);
  if (self.factorise(matrix)) return true;
  // A strand may be singular by itself although the whole matrix is not.
  if (!self.pattern->is_cut) return false;
  self.analyse(matrix, part, false);
  return self.factorise(matrix);
}

bool KktSolver::renew(const Eigen::MatrixXd& change) {
  Implementation& self = *implementation_;
  self.corner = self.schur;
  self.corner.topLeftCorner(change.rows(), change.cols()) += change;
  return self.factorise_corner();
}

void KktSolver::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const {
  implementation_->solve(rhs, x);
}

void KktSolver::solve(const Columns& rhs, Columns& x) const {
  const Implementation& self = *implementation_;
  const BandedLu* band = self.strands.size() == 1 ? self.strands.front().banded() : nullptr;
  if (band && self.pattern->part.empty()) return band->solve(rhs, x);
  x.resize(rhs.rows(), rhs.cols());
  Eigen::VectorXd of_one;
  for (Eigen::Index column = 0; column < rhs.cols(); ++column) {
    solve(rhs.col(column), of_one);
    x.col(column) = of_one;
  }
}

Eigen::VectorXd KktSolver::solve(const Eigen::VectorXd& rhs) const {
  Eigen::VectorXd x;
  solve(rhs, x);
  return x;
}

}  // namespace nurbeam
