#include "solver/algebra/eigenpairs.h"

#include <Spectra/SymEigsSolver.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "solver/algebra/equilibrated_kkt.h"
#include "solver/algebra/kkt_solver.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Vectors = Eigen::MatrixXd;

/// The transformed problem. With S the constrained inverse of B (y = S x: B y + G'z = x, G y = 0) and B + w
/// G'G = L L', the symmetric matrix C = L'S A S L has the eigenvalues theta, with z = L'x for x; where S
/// vanishes C is zero. The coordinates are those in which `kkt` is equilibrated.
class Transformed {
 public:
  Transformed(const Matrix& A, const Matrix& kkt)
      : n_(static_cast<int>(A.rows())), factor_(equilibration(kkt, n_)), A_(scaled(A, factor_.head(n_))) {
    const Matrix level = scaled(kkt, factor_);
    const Matrix G = level.bottomLeftCorner(level.rows() - n_, n_);
    if (!inverse_.factorise(level)) return;
    // B may be indefinite where G x is not 0: w grows until G'G outweighs that.
    for (double weight = 1; weight < 1e7 && !regular_; weight *= 100) {
      cholesky_.compute(Matrix(level.topLeftCorner(n_, n_)) + weight * Matrix(G.transpose() * G));
      regular_ = cholesky_.info() == Eigen::Success;
    }
  }

  bool regular() const { return regular_; }
  int size() const { return n_; }
  Vector times(const Vector& z) const { return untransformed(inverse(A_ * inverse(transformed(z)))); }
  /// x for a vector z, in the original coordinates.
  Vector vector_of(const Vector& z) const { return factor_.head(n_).cwiseProduct(inverse(transformed(z))); }

 private:
  // The Cholesky factor is P'L with a permutation P.
  Vector transformed(const Vector& z) const {
    return cholesky_.permutationPinv() * Vector(cholesky_.matrixL() * z);
  }
  Vector untransformed(const Vector& x) const {
    return cholesky_.matrixU() * Vector(cholesky_.permutationP() * x);
  }
  Vector inverse(const Vector& x) const {
    Vector padded = Vector::Zero(factor_.size());
    padded.head(n_) = x;
    return inverse_.solve(padded).head(n_);
  }

  int n_;
  Vector factor_;
  Matrix A_;
  Eigen::SimplicialLLT<Matrix> cholesky_;
  KktSolver inverse_;
  bool regular_ = false;
};

/// C without the pairs that were found, for Spectra.
class Deflated {
 public:
  using Scalar = double;
  Deflated(const Transformed& C, const Vectors& found, const std::function<void()>& between)
      : C_(C), found_(found), between_(between) {}

  Eigen::Index rows() const { return C_.size(); }
  Eigen::Index cols() const { return C_.size(); }
  void perform_op(const double* x, double* y) const {
    between_();
    const Vector z = without_found(Eigen::Map<const Vector>(x, rows()));
    Eigen::Map<Vector>(y, rows()) = without_found(C_.times(z));
  }

 private:
  Vector without_found(const Vector& z) const {
    if (found_.cols() == 0) return z;
    return z - found_ * (found_.transpose() * z);
  }

  const Transformed& C_;
  const Vectors& found_;
  const std::function<void()>& between_;
};

/// Eigenvalues and vectors z that one start finds besides `found`.
std::optional<Eigenpairs> find(const Transformed& C, const Vectors& found, int count,
                               const std::function<void()>& between) {
  Deflated op(C, found, between);
  const int wanted = std::min(count, C.size() - 1);
  const int subspace = std::min(C.size(), std::max(2 * wanted + 1, 20));
  constexpr int most_restarts = 1000;
  constexpr double tolerance = 1e-11;
  Spectra::SymEigsSolver<Deflated> lanczos(op, wanted, subspace);
  lanczos.init();
  lanczos.compute(Spectra::SortRule::LargestMagn, most_restarts, tolerance, Spectra::SortRule::LargestMagn);
  if (lanczos.info() != Spectra::CompInfo::Successful) return std::nullopt;
  return Eigenpairs{lanczos.eigenvalues(), lanczos.eigenvectors(wanted)};
}

/// All eigenpairs of a small C, from its columns.
std::optional<Eigenpairs> all_of(const Transformed& C, const std::function<void()>& between) {
  Vectors columns(C.size(), C.size());
  for (int i = 0; i < C.size(); ++i) {
    between();
    columns.col(i) = C.times(Vector::Unit(C.size(), i));
  }
  const Eigen::SelfAdjointEigenSolver<Vectors> solver((columns + columns.transpose()) / 2);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return Eigenpairs{solver.eigenvalues(), solver.eigenvectors()};
}

/// The nonzero pairs of both sets, the largest first.
Eigenpairs merged(const Eigenpairs& a, const Eigenpairs& b) {
  Vector values(a.values.size() + b.values.size());
  values << a.values, b.values;
  Vectors vectors(b.vectors.rows(), values.size());
  vectors << a.vectors, b.vectors;
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  const double zero = 1e-13 * values.cwiseAbs().maxCoeff();
  std::erase_if(
      order, [&](int i) { return !(std::abs(values[i]) > zero); });
  std::stable_sort(order.begin(), order.end(),
                   [&](int i, int j) { return std::abs(values[i]) > std::abs(values[j]); });
  return {values(order), vectors(Eigen::all, order)};
}

}  // namespace

std::optional<Eigenpairs> largest_eigenpairs(const Matrix& A, const Matrix& kkt, int count,
                                             const std::function<void()>& between) {
  const Transformed C(A, kkt);
  if (!C.regular() || C.size() < 2) return std::nullopt;
  Eigenpairs found{Vector(0), Vectors(C.size(), 0)};
  // If most pairs are wanted, the iteration would search among round-off.
  constexpr int few = 64;
  const bool dense = C.size() <= few || C.size() <= 3 * count;
  if (dense) {
    const std::optional<Eigenpairs> all = all_of(C, between);
    if (!all) return std::nullopt;
    found = merged(found, *all);
  }
  constexpr double same = 1e-9;
  for (bool missing = !dense; missing;) {
    const std::optional<Eigenpairs> more = find(C, found.vectors, count, between);
    if (!more) return std::nullopt;
    const auto known = found.values.size();
    // If enough pairs are known, only a larger eigenvalue matters.
    const double least = known >= count ? (1 + same) * std::abs(found.values[count - 1]) : 0;
    missing = more->values.size() > 0 && std::abs(more->values[0]) > least;
    if (missing) found = merged(found, *more);
    missing = missing && found.values.size() > known;
  }
  const auto kept = std::min<Eigen::Index>(count, found.values.size());
  Eigenpairs result{found.values.head(kept), Vectors(C.size(), kept)};
  for (Eigen::Index i = 0; i < kept; ++i) result.vectors.col(i) = C.vector_of(found.vectors.col(i));
  return result;
}

}  // namespace nurbeam
