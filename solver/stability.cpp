#include "solver/stability.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/equilibrated_kkt.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// What factorisation leaves of a zero eigenvalue of a matrix whose entries are at most 1: the rigid motions
/// of free rings came out at up to 2e-13.
constexpr double zero_eigenvalue = 5e-13;
/// Small beside K, so that directions that the constraints forbid count as stiff; not so small that they
/// drown the soft ones in round-off. Where that makes too soft what they forbid, less, of which more is
/// round-off.
constexpr double first_regularisation = 1e-2, least_regularisation = 1e-8, finer = 1e-3;

/// [[K + shift, G'], [G, -r]], r the regularisation, equilibrated and factorised. By Sylvester's law it has
/// as many negative pivots as the augmented K + shift + G'G/r has negative eigenvalues, and one for each
/// constraint.
class ShiftedTangent {
 public:
  ShiftedTangent(const Matrix& kkt, int n)
      : factor_(equilibration(kkt, n)), kkt_(scaled(kkt, factor_)), shifted_(kkt_), n_(n) {
    solver_.analyzePattern(shifted_);
  }

  void set_regularisation(double r) { regularisation_ = r; }

  /// Eigenvalues that are no greater are round-off.
  double round_off() const { return zero_eigenvalue * first_regularisation / regularisation_; }

  /// The number of negative eigenvalues of K + shift on the null space of G.
  int factorise(double shift) {
    shifted_.coeffs() = kkt_.coeffs();
    for (int i = 0; i < shifted_.cols(); ++i) shifted_.coeffRef(i, i) += i < n_ ? shift : -regularisation_;
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

  /// By how much the augmented K falls along x: less is round_off().
  double descent(const Vector& x) const {
    const double forbidden = (kkt_.bottomLeftCorner(kkt_.rows() - n_, n_) * x).squaredNorm();
    return -(x.dot(kkt_.topLeftCorner(n_, n_) * x) + forbidden / regularisation_) / x.squaredNorm();
  }
  /// What of it the constraints allow.
  Vector allowed(const Vector& x) const {
    const Matrix G = kkt_.bottomLeftCorner(kkt_.rows() - n_, n_);
    if (G.rows() == 0) return x;
    Matrix across = G * Matrix(G.transpose()), identity(G.rows(), G.rows());
    identity.setIdentity();
    constexpr double little = 1e-14;  // of constraints that say the same
    const Eigen::SimplicialLDLT<Matrix> solver(across + little * identity);
    if (solver.info() != Eigen::Success) return x;
    return x - G.transpose() * Vector(solver.solve(Vector(G * x)));
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
  double regularisation_ = first_regularisation;
  Eigen::SimplicialLDLT<Matrix> solver_;
};

/// The eigenvector of the lowest eigenvalue, which is below that of round-off.
Vector lowest_of(ShiftedTangent& tangent) {
  double negative = tangent.round_off(), positive = 10 * negative;  // it is between -positive and -negative
  while (tangent.factorise(positive) > 0 && positive < 10) {
    negative = positive;
    positive *= 10;
  }
  while (positive > 1.1 * negative) {
    const double middle = std::sqrt(positive * negative);
    (tangent.factorise(middle) > 0 ? negative : positive) = middle;
  }
  tangent.factorise(positive);
  return tangent.nearest_eigenvector();
}

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
  double descent = std::numeric_limits<double>::infinity();
  for (double r = first_regularisation; r >= least_regularisation; r *= finer) {
    tangent.set_regularisation(r);
    const int unstable = tangent.factorise(tangent.round_off());
    // Unless what was found before is too flat to be seen now.
    if (unstable == 0) return descent > tangent.round_off() ? Stability{} : result;
    const Vector lowest = lowest_of(tangent);
    if (!(tangent.descent(lowest) > tangent.round_off()))  // pivots of round-off
      return descent > tangent.round_off() ? Stability{} : result;
    descent = tangent.descent(lowest);
    result = {.unstable_directions = unstable, .direction = tangent.direction(lowest)};
    if (tangent.descent(tangent.allowed(lowest)) > tangent.round_off()) return result;
  }
  return result;
}

}  // namespace nurbeam
