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

  /// Takes the pattern of a compressed square matrix; whether there are matrices of it that are regular.
  [[nodiscard]] bool analyse(const Matrix& matrix);
  /// Of a matrix of that pattern. Returns KLU's own estimate of the reciprocal condition, smallest over
  /// largest pivot of the row-scaled factors: 0 where it is singular.
  [[nodiscard]] double factorise(const Matrix& matrix);
  /// x with matrix x = rhs, of the last matrix, which must be regular.
  Vector solve(const Vector& rhs) const;

 private:
  struct Klu;
  std::unique_ptr<Klu> klu_;
};

}  // namespace nurbeam
