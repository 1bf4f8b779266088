#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <utility>
#include <vector>

namespace nurbeam {

/// SparseView: a compressed matrix to read; SparseValues: one whose values are written. Their indices may be
/// those of a pattern.
using SparseView = Eigen::Ref<const Eigen::SparseMatrix<double>>;
using SparseValues = Eigen::Ref<Eigen::SparseMatrix<double>>;

/// Whether two columns have entries in the same rows.
inline bool have_same_rows(const SparseView& matrix, int one, int other) {
  const int *starts = matrix.outerIndexPtr(), *rows = matrix.innerIndexPtr();
  return std::equal(rows + starts[one], rows + starts[one + 1], rows + starts[other],
                    rows + starts[other + 1]);
}

/// The positions of the entries of a square sparse matrix: column by column, the rows of each in order.
class SparsePattern {
 public:
  SparsePattern() : column_starts_{0} {}
  /// `column_starts`: index among `rows` of the first entry of each column, and the end.
  SparsePattern(std::vector<int> column_starts, std::vector<int> rows)
      : column_starts_(std::move(column_starts)), rows_(std::move(rows)) {}
  /// The pattern of a compressed matrix.
  explicit SparsePattern(const Eigen::SparseMatrix<double>& matrix)
      : column_starts_(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1),
        rows_(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros()) {}

  /// Number of the matrix's rows, and of its columns.
  int size() const { return static_cast<int>(column_starts_.size()) - 1; }
  const std::vector<int>& column_starts() const { return column_starts_; }
  const std::vector<int>& rows() const { return rows_; }

  /// The compressed matrix of the pattern, with zero values.
  Eigen::SparseMatrix<double> matrix() const {
    Eigen::SparseMatrix<double> zero(size(), size());
    zero.resizeNonZeros(static_cast<Eigen::Index>(rows_.size()));
    std::copy(column_starts_.begin(), column_starts_.end(), zero.outerIndexPtr());
    std::copy(rows_.begin(), rows_.end(), zero.innerIndexPtr());
    zero.coeffs().setZero();
    return zero;
  }

  /// The matrix with rows().size() values of the caller's own. It refers to the pattern, and only its values
  /// may be written.
  Eigen::Map<Eigen::SparseMatrix<double>> matrix_of(double* values) const {
    return {size(),
            size(),
            static_cast<Eigen::Index>(rows_.size()),
            const_cast<int*>(column_starts_.data()),
            const_cast<int*>(rows_.data()),
            values};
  }

  bool operator==(const SparsePattern&) const = default;

 private:
  std::vector<int> column_starts_, rows_;
};

}  // namespace nurbeam
