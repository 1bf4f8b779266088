#include "solver/rest/mechanism.h"

#include "solver/algebra/equilibrated_kkt.h"
#include "solver/algebra/kkt_solver.h"
#include "solver/algebra/without_symmetry.h"
#include "solver/system/force_sizes.h"
#include "solver/system/scaled_equations.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

class MechanismSearch {
 public:
  MechanismSearch(const SecondOrderSystem& system, const State& equilibrium)
      : at_(equilibrium), scale_(system.coordinate_scale()), equations_(system, equilibrium) {
    equations_.rescale(at_, ForceSizes(system).largest_force(at_));
  }

  std::optional<Vector> softest_motion() {
    const Vector motion = softest();
    return motion.size() > 0 ? std::optional<Vector>(motion.cwiseProduct(scale_)) : std::nullopt;
  }

  std::optional<Vector> run() {
    const Vector motion = softest();
    if (motion.size() == 0) return std::nullopt;
    // A large move may be inadmissible, as of a body beyond its element, or may lead Newton's method astray.
    constexpr double largest = 0.1, least = 1e-4, shorter = 1.0 / 3;
    for (double amplitude = largest; amplitude > least; amplitude *= shorter)
      for (const double sign : {1.0, -1.0})
        if (const auto remains = stays(sign * amplitude * motion))
          return *remains ? std::optional<Vector>(motion.cwiseProduct(scale_)) : std::nullopt;
    return std::nullopt;
  }

 private:
  /// Shift of the eigenvalues of the equilibrated K. Zero eigenvalues then move nothing by round-off, and the
  /// shift is small beside those of the softest models whose equilibria are found at all.
  static constexpr double shift = 1e-13;

  /// Factorises the tangent at some unknowns, shifted, in the equations' scaled coordinates, equilibrated as
  /// far as possible.
  bool factorise(const Vector& x) {
    if (!equations_.differentiate(x)) return false;
    const int n = equations_.coordinates();
    factor_ = equilibration(equations_.tangent(), n);
    Matrix kkt = scaled(equations_.tangent(), factor_);
    for (int i = 0; i < n; ++i) kkt.coeffRef(i, i) += shift;
    return solver_.factorise(kkt);
  }

  /// (n) The softest motion by inverse iteration, in scaled coordinates; empty where all motions are stiff.
  Vector softest() {
    constexpr int iterations = 6;
    constexpr double soft = 1e-9;  // an eigenvalue below this may be zero
    if (!factorise(equations_.scaled_unknowns(at_))) return {};
    const int n = equations_.coordinates();
    Vector x = without_symmetry(n).normalized(), padded = Vector::Zero(equations_.size());
    for (int i = 0; i < iterations; ++i) {
      padded.head(n) = x;
      x = solver_.solve(padded).head(n);
      const double length = x.norm();
      if (!(length * soft > 1)) return {};
      x /= length;
    }
    x = x.cwiseProduct(factor_.head(n));
    return x / x.lpNorm<Eigen::Infinity>();
  }

  /// Whether Newton's method leads from the moved state to an equilibrium about as far away; nothing if it
  /// leads to none. A motion ten times softer than the shift has gone half of its way back after the least
  /// number of iterations.
  std::optional<bool> stays(const Vector& move) {
    constexpr int least = 8, most = 20;
    constexpr double tolerance = 1e-10, left = 0.75;  // part of the move
    const int n = equations_.coordinates();
    const Vector start = equations_.scaled_unknowns(at_);
    Vector x = start, rows(x.size());
    x.head(n) += move;
    for (int i = 1; i <= most; ++i) {
      if (!equations_.evaluate(x, rows) || !factorise(x)) return std::nullopt;
      x -= factor_.cwiseProduct(solver_.solve(factor_.cwiseProduct(rows)));
      if (!equations_.quality(x, tolerance).acceptable) continue;
      const bool remains = (x - start).head(n).dot(move) >= left * move.squaredNorm();
      if (!remains || i >= least) return remains;
    }
    return std::nullopt;
  }

  const State at_;
  const Vector scale_;
  ScaledEquations equations_;
  Vector factor_;
  KktSolver solver_;
};

}  // namespace

namespace {

constexpr int most_coordinates = 10000;  // a chain with more is as soft as round-off

}  // namespace

std::optional<Vector> softest_motion(const SecondOrderSystem& system, const State& state) {
  if (system.coordinate_count() > most_coordinates) return std::nullopt;
  return MechanismSearch(system, resting(system, state)).softest_motion();
}

std::optional<Vector> find_mechanism(const SecondOrderSystem& system, const State& equilibrium) {
  if (system.coordinate_count() > most_coordinates) return std::nullopt;
  return MechanismSearch(system, resting(system, equilibrium)).run();
}

}  // namespace nurbeam
