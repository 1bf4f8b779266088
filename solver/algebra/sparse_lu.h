#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace nurbeam {

/// LU of real or complex matrices of one sparse pattern, by KLU.
template <class Scalar>
class SparseLu {
 public:
  using Matrix = Eigen::SparseMatrix<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  SparseLu();
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// Takes the pattern of a compressed square matrix; returns whether matrices with this pattern can be
  /// regular.
  [[nodiscard]] bool analyse(const Matrix& matrix);
  /// Factorises a matrix of the pattern. Returns KLU's own estimate of the reciprocal condition, smallest
  /// over largest pivot of the row-scaled factors: 0 where the matrix is singular.
  [[nodiscard]] double factorise(const Matrix& matrix);
  /// x with matrix x = rhs, for the last matrix, which must be regular.
  Vector solve(const Vector& rhs) const;

 private:
  struct Klu;
  std::unique_ptr<Klu> klu_;
};

}  // namespace nurbeam
