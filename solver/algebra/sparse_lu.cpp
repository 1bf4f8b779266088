#include "solver/algebra/sparse_lu.h"

#include <Eigen/KLUSupport>
#include <complex>
#include <type_traits>

namespace nurbeam {

template <class Scalar>
struct SparseLu<Scalar>::Klu : Eigen::KLU<Matrix> {
  double reciprocal_condition() {
    if constexpr (std::is_same_v<Scalar, double>)
      klu_rcond(this->m_symbolic, this->m_numeric, &this->m_common);
    else
      klu_z_rcond(this->m_symbolic, this->m_numeric, &this->m_common);
    return this->m_common.rcond;
  }
};

template <class Scalar>
SparseLu<Scalar>::SparseLu() : klu_(std::make_unique<Klu>()) {}
template <class Scalar>
SparseLu<Scalar>::~SparseLu() = default;
template <class Scalar>
SparseLu<Scalar>::SparseLu(SparseLu&&) noexcept = default;
template <class Scalar>
SparseLu<Scalar>& SparseLu<Scalar>::operator=(SparseLu&&) noexcept = default;

template <class Scalar>
bool SparseLu<Scalar>::analyse(const Matrix& matrix) {
  klu_->analyzePattern(matrix);
  return klu_->info() == Eigen::Success;
}

template <class Scalar>
double SparseLu<Scalar>::factorise(const Matrix& matrix) {
  klu_->factorize(matrix);
  return klu_->info() == Eigen::Success ? klu_->reciprocal_condition() : 0;
}

template <class Scalar>
typename SparseLu<Scalar>::Vector SparseLu<Scalar>::solve(const Vector& rhs) const {
  return klu_->solve(rhs);
}

template class SparseLu<double>;
template class SparseLu<std::complex<double>>;

}  // namespace nurbeam
