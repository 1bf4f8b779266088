#include "solver/stability.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "solver/equilibrated_kkt.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// What factorisation leaves of a zero eigenvalue of a matrix whose entries are at most 1: the rigid motions
/// of free rings came out at up to 2e-13.
constexpr double zero_eigenvalue = 5e-13;
/// Small beside K, so that directions that the constraints forbid count as stiff; not so small that they
/// drown the soft ones in round-off.
constexpr double regularisation = 1e-2;

/// [[K + shift, G'], [G, -regularisation]], equilibrated and factorised. By Sylvester's law it has as many
/// negative pivots as the augmented K + shift + G'G/regularisation has negative eigenvalues, and one for each
/// constraint.
class ShiftedTangent {
 public:
  ShiftedTangent(const Matrix& kkt, int n)
      : factor_(equilibration(kkt, n)), kkt_(scaled(kkt, factor_)), shifted_(kkt_), n_(n) {
    solver_.analyzePattern(shifted_);
  }

  /// The number of negative eigenvalues of K + shift on the null space of G.
  int factorise(double shift) {
    shifted_.coeffs() = kkt_.coeffs();
    for (int i = 0; i < shifted_.cols(); ++i) shifted_.coeffRef(i, i) += i < n_ ? shift : -regularisation;
    solver_.factorize(shifted_);
    if (solver_.info() != Eigen::Success) return n_;
    const auto negative = (solver_.vectorD().array() < 0).count();
    return std::max(0, static_cast<int>(negative) - (static_cast<int>(shifted_.cols()) - n_));
  }

  /// The eigenvector of the equilibrated K on the null space of G whose eigenvalue is nearest to -shift.
  Vector nearest_eigenvector() const {
    constexpr int iterations = 30;
    Vector x = Vector::Zero(shifted_.cols());
    for (int i = 0; i < n_; ++i) x[i] = 1 + 0.5 * std::sin(12.9898 * (i + 1));  // no symmetry of its own
    for (int i = 0; i < iterations; ++i) {
      x.tail(x.size() - n_).setZero();
      x = solver_.solve(Vector(x / x.norm()));
    }
    return x.head(n_).normalized();
  }

  bool descends(const Vector& x) const {
    const double forbidden = (kkt_.bottomLeftCorner(kkt_.rows() - n_, n_) * x).squaredNorm();
    return x.dot(kkt_.topLeftCorner(n_, n_) * x) + forbidden / regularisation <
           -zero_eigenvalue * x.squaredNorm();
  }
  /// In the coordinates that were given, of unit length, the largest component positive.
  Vector direction(const Vector& x) const {
    const Vector given = factor_.head(n_).cwiseProduct(x).normalized();
    Eigen::Index largest = 0;
    given.cwiseAbs().maxCoeff(&largest);
    return given[largest] < 0 ? Vector(-given) : given;
  }

 private:
  Vector factor_;
  Matrix kkt_, shifted_;
  int n_;
  Eigen::SimplicialLDLT<Matrix> solver_;
};

}  // namespace

bool is_symmetric(const Matrix& kkt, int n) {
  const Matrix K = kkt.topLeftCorner(n, n);
  const Matrix difference = K - Matrix(K.transpose());
  const double largest = K.coeffs().size() > 0 ? K.coeffs().abs().maxCoeff() : 0;
  return difference.nonZeros() == 0 || difference.coeffs().abs().maxCoeff() <= 1e-9 * largest;
}

std::optional<Stability> stability(const Matrix& kkt, int n) {
  if (!is_symmetric(kkt, n)) return std::nullopt;
  ShiftedTangent tangent(kkt, n);
  Stability result;
  result.unstable_directions = tangent.factorise(zero_eigenvalue);
  if (result.unstable_directions == 0) return result;

  // The lowest eigenvalue, between -positive and -negative.
  double negative = zero_eigenvalue, positive = 10 * negative;
  while (tangent.factorise(positive) > 0 && positive < 10) {
    negative = positive;
    positive *= 10;
  }
  while (positive > 1.1 * negative) {
    const double middle = std::sqrt(positive * negative);
    (tangent.factorise(middle) > 0 ? negative : positive) = middle;
  }
  tangent.factorise(positive);
  const Vector lowest = tangent.nearest_eigenvector();
  if (!tangent.descends(lowest)) return Stability{};  // pivots of round-off
  result.direction = tangent.direction(lowest);
  return result;
}

}  // namespace nurbeam
