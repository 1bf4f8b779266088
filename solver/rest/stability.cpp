#include "solver/rest/stability.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "solver/algebra/equilibrated_kkt.h"
#include "solver/algebra/kkt_solver.h"
#include "solver/algebra/without_symmetry.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// Round-off of a zero eigenvalue in the factorisation of a matrix whose entries are at most 1: rigid motions
/// of free rings came out at up to 2e-13.
constexpr double zero_eigenvalue = 5e-13;
/// Regularisations. They are small beside K, so that directions that the constraints forbid count as stiff;
/// not so small that they drown the soft ones in round-off. Where forbidden directions still look unstable,
/// smaller ones are tried, with more round-off.
constexpr double first_regularisation = 1e-2, least_regularisation = 1e-8, finer = 1e-3;

/// A direction in the coordinates before they were multiplied by `factor`, of unit length, with the sign that
/// makes the largest component positive.
Vector given_direction(const Vector& factor, const Vector& x) {
  const Vector given = factor.head(x.size()).cwiseProduct(x).normalized();
  Eigen::Index largest = 0;
  given.cwiseAbs().maxCoeff(&largest);
  return given[largest] < 0 ? Vector(-given) : given;
}

/// [[K + shift, G'], [G, -r]], r the regularisation, equilibrated and factorised. By Sylvester's law this
/// matrix has as many negative pivots as the augmented K + shift + G'G/r has negative eigenvalues, and one
/// more for each constraint.
class ShiftedTangent {
 public:
  ShiftedTangent(const Matrix& kkt, int n)
      : factor_(equilibration(kkt, n)), kkt_(scaled(kkt, factor_)), shifted_(kkt_), n_(n) {
    solver_.analyzePattern(shifted_);
  }

  void set_regularisation(double r) { regularisation_ = r; }

  /// Size up to which eigenvalues are round-off.
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
    x.head(n_) = without_symmetry(n_);
    for (int i = 0; i < iterations; ++i) {
      x.tail(x.size() - n_).setZero();
      x = solver_.solve(Vector(x / x.norm()));
    }
    return x.head(n_).normalized();
  }

  /// The descent of the augmented K along x; below round_off() it does not count.
  double descent(const Vector& x) const {
    const double forbidden = (kkt_.bottomLeftCorner(kkt_.rows() - n_, n_) * x).squaredNorm();
    return -(x.dot(kkt_.topLeftCorner(n_, n_) * x) + forbidden / regularisation_) / x.squaredNorm();
  }
  /// The part of x that the constraints allow.
  Vector allowed(const Vector& x) const {
    const Matrix G = kkt_.bottomLeftCorner(kkt_.rows() - n_, n_);
    if (G.rows() == 0) return x;
    Matrix across = G * Matrix(G.transpose()), identity(G.rows(), G.rows());
    identity.setIdentity();
    constexpr double little = 1e-14;  // for constraints that depend on one another
    const Eigen::SimplicialLDLT<Matrix> solver(across + little * identity);
    if (solver.info() != Eigen::Success) return x;
    return x - G.transpose() * Vector(solver.solve(Vector(G * x)));
  }
  Vector direction(const Vector& x) const { return given_direction(factor_, x); }

 private:
  Vector factor_;
  Matrix kkt_, shifted_;
  int n_;
  double regularisation_ = first_regularisation;
  Eigen::SimplicialLDLT<Matrix> solver_;
};

/// The eigenvector of the lowest eigenvalue, which must be below -round_off().
Vector lowest_of(ShiftedTangent& tangent) {
  // The eigenvalue is between -positive and -negative.
  double negative = tangent.round_off(), positive = 10 * negative;
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

/// An orthonormal basis V (n x (k + 1)) of a vector and its repeated products with a matrix A, with A V_k = V
/// H.
struct Krylov {
  Eigen::MatrixXd V, H;
};

Krylov arnoldi(int n, const std::function<Vector(const Vector&)>& times) {
  constexpr int most = 40;
  constexpr double nothing = 1e-13;
  const int size = std::min(most, n);
  Krylov krylov{Eigen::MatrixXd::Zero(n, size + 1), Eigen::MatrixXd::Zero(size + 1, size)};
  auto& [V, H] = krylov;
  V.col(0) = times(without_symmetry(n)).normalized();
  for (int k = 0; k < size; ++k) {
    Vector next = times(V.col(k));
    const double length = next.norm();
    for (int pass = 0; pass < 2; ++pass) {  // once more, for the round-off of the first pass
      const Vector along = V.leftCols(k + 1).transpose() * next;
      next -= V.leftCols(k + 1) * along;
      H.col(k).head(k + 1) += along;
    }
    if (!(next.norm() > nothing * length)) return {V.leftCols(k + 2), H.topLeftCorner(k + 2, k + 1)};
    H(k + 1, k) = next.norm();
    V.col(k + 1) = next.normalized();
  }
  return krylov;
}

/// The pencil K x = lambda M x + G'y, G x = 0 in the equilibrated coordinates. M is the identity, or a given
/// matrix that is made regular and at most of order 1.
class Pencil {
 public:
  Pencil(const Matrix& kkt, int n) : Pencil(kkt, n, Matrix(n, n), 1) {}
  Pencil(const Matrix& kkt, int n, const Matrix& mass) : Pencil(kkt, n, mass, 1e-9) {}

  /// An instability by an eigenvector whose lambda has a negative real part, not below -`least`, and beyond
  /// round-off.
  Stability falls(double least) const {
    for (double a = least; a > zero_eigenvalue; a /= 10)
      if (const Vector x = falling(a); x.size() > 0)
        return {.unstable_directions = 1, .direction = given_direction(factor_, x)};
    return {};
  }

  /// A number a such that no lambda has a real part below -a: the symmetric part of K + a M is positive
  /// definite on the null space of G. Where round-off of the constraints hides that, a is larger.
  double bound() const {
    const Matrix symmetric = (kkt_ + Matrix(kkt_.transpose())) / 2;
    double a = zero_eigenvalue;
    while (a < 1 / zero_eigenvalue && !is_definite(symmetric + a * mass_)) a *= 10;
    return a;
  }

 private:
  bool is_definite(const Matrix& kkt) const {
    ShiftedTangent tangent(kkt, n_);
    return tangent.factorise(tangent.round_off()) == 0;
  }
  Pencil(const Matrix& kkt, int n, const Matrix& mass, double everywhere)
      : factor_(equilibration(kkt, n)), kkt_(scaled(kkt, factor_)), mass_(kkt_.rows(), kkt_.cols()), n_(n) {
    const Matrix level = scaled(mass, factor_.head(n));
    const double heaviest = level.nonZeros() > 0 ? level.coeffs().abs().maxCoeff() : 0;
    std::vector<Eigen::Triplet<double>> entries;
    for (int column = 0; column < n; ++column) {
      entries.emplace_back(column, column, everywhere);
      for (Matrix::InnerIterator entry(level, column); entry && heaviest > 0; ++entry)
        entries.emplace_back(entry.row(), column, entry.value() / heaviest);
    }
    mass_.setFromTriplets(entries.begin(), entries.end());
  }

  /// An unstable direction among the eigenvectors with lambda near -a, found by Arnoldi's iteration with (K +
  /// a M)^-1 M; empty if there is none.
  Vector falling(double a) const {
    constexpr double aside = 1.3;  // factor that moves a off an eigenvalue
    KktSolver solver;
    if (!solver.factorise(Matrix(kkt_ + a * mass_))) {
      a *= aside;
      if (!solver.factorise(Matrix(kkt_ + a * mass_))) return {};
    }
    return falling(a, arnoldi(n_, [&](const Vector& x) -> Vector {
                     Vector padded = Vector::Zero(kkt_.rows());
                     padded.head(n_) = x;
                     return solver.solve(mass_ * padded).head(n_);
                   }));
  }
  Vector falling(double a, const Krylov& krylov) const {
    const auto& [V, H] = krylov;
    const auto count = H.cols();
    const Eigen::EigenSolver<Eigen::MatrixXd> ritz(H.topRows(count));
    if (ritz.info() != Eigen::Success) return {};
    constexpr double converged = 1e-9, of_the_shift = 1e-3;
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::complex<double> theta = ritz.eigenvalues()[i];
      const Eigen::VectorXcd z = ritz.eigenvectors().col(i).normalized();
      const bool found = std::abs(H(count, count - 1) * z[count - 1]) <= converged * std::abs(theta);
      if (!found || !((1.0 / theta).real() - a < -of_the_shift * a)) continue;
      const Vector x = lower(V.leftCols(count) * z.real(), V.leftCols(count) * z.imag());
      if (quotient(x) < -zero_eigenvalue) return x;
    }
    return {};
  }
  Vector lower(const Vector& x, const Vector& y) const {
    return !(y.norm() > 0) || (x.norm() > 0 && quotient(x) < quotient(y)) ? x : y;
  }
  double quotient(const Vector& x) const { return x.dot(kkt_.topLeftCorner(n_, n_) * x) / x.squaredNorm(); }

  Vector factor_;
  Matrix kkt_, mass_;
  int n_;
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
  double descent = std::numeric_limits<double>::infinity();
  for (double r = first_regularisation; r >= least_regularisation; r *= finer) {
    tangent.set_regularisation(r);
    const int unstable = tangent.factorise(tangent.round_off());
    const Vector lowest = unstable > 0 ? lowest_of(tangent) : Vector();
    // Or negative pivots were round-off.
    if (unstable == 0 || !(tangent.descent(lowest) > tangent.round_off())) {
      // A descent found before may be too flat to be seen now.
      return descent > tangent.round_off() ? Stability{} : Pencil(kkt, n).falls(2 * descent);
    }
    descent = tangent.descent(lowest);
    result = {.unstable_directions = unstable, .direction = tangent.direction(lowest)};
    if (tangent.descent(tangent.allowed(lowest)) > tangent.round_off()) return result;
  }
  return result;
}

Stability divergence(const Matrix& kkt, int n, const std::function<Matrix()>& mass) {
  const Matrix symmetric = (kkt + Matrix(kkt.transpose())) / 2;
  // No real part of lambda is below its least eigenvalue.
  if (stability(symmetric, n)->unstable_directions == 0) return {};
  const Pencil pencil(kkt, n, mass());
  return pencil.falls(pencil.bound());
}

}  // namespace nurbeam
