#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <limits>
#include <vector>

#include "solver/algebra/sparse_pattern.h"
#include "solver/system/state.h"

namespace nurbeam {

/// Factors of the three tangents in the iteration matrix.
struct TangentWeights {
  double mass = 0;       ///< weight of d(dynamics)/da
  double damping = 0;    ///< weight of d(dynamics)/dv
  double stiffness = 0;  ///< weight of d(dynamics)/dq
};

/// M(q) a + G'lambda = f(q, v, t), g(q, t) = 0, and their tangents: all that an integrator may know.
///
/// n = coordinate_count(), m = constraint_count(); G = dg/dq (m x n). All calls are const and without side
/// effect. Those of an integrator's step allocate nothing once the output arguments have their sizes.
class SecondOrderSystem {
 public:
  virtual ~SecondOrderSystem() = default;
  virtual int coordinate_count() const = 0;
  virtual int constraint_count() const = 0;

  /// dynamics (n) = M(q) a - f(q, v, t) + G'lambda; constraints (m) = g(q, t).
  virtual void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                        Eigen::Ref<Eigen::VectorXd> constraints) const = 0;

  /// constraints (m) = g(q, t) alone.
  virtual void constraints(const State& state, Eigen::Ref<Eigen::VectorXd> constraints) const {
    Eigen::VectorXd dynamics(coordinate_count());
    residual(state, dynamics, constraints);
  }

  /// The fixed pattern of `tangent`, (n+m) x (n+m), the diagonal of the (2,2) block included.
  virtual const SparsePattern& tangent_pattern() const = 0;

  /// Values of [[w.mass dF/da + w.damping dF/dv + w.stiffness dF/dq, dF/dlambda], [G, 0]], F = dynamics at
  /// `state` (lambda included), into a matrix of tangent_pattern(). dF/dlambda is G' where all weights
  /// are 0.
  virtual void tangent(const State& state, const TangentWeights& w, SparseValues kkt) const = 0;

  /// The tangents for two sets of weights.
  virtual void tangents(const State& state, const std::array<TangentWeights, 2>& w,
                        const std::array<Eigen::SparseMatrix<double>*, 2>& kkt) const {
    for (const std::size_t k : {0, 1}) tangent(state, w[k], *kkt[k]);
  }

  /// The residual in the rows of coordinates that are `near` (n+m) and in all constraints; other rows are
  /// undefined.
  virtual void residual_near(const State& state, const std::vector<bool>& near,
                             Eigen::Ref<Eigen::VectorXd> dynamics,
                             Eigen::Ref<Eigen::VectorXd> constraints) const {
    (void)near;
    residual(state, dynamics, constraints);
  }

  /// Adds the tangent near some unknowns (n+m) to `values`, the entries of tangent_pattern(). Entries are
  /// added in the columns of these unknowns and of all unknowns coupled with them; only the rows of these
  /// unknowns are complete.
  virtual void tangent_near(const State& state, const TangentWeights& w, const std::vector<bool>& near,
                            double* values) const {
    Eigen::SparseMatrix<double> whole = tangent_pattern().matrix();
    tangent(state, w, whole);
    for (Eigen::Index column = 0; column < whole.cols(); ++column)
      for (int k = whole.outerIndexPtr()[column]; k < whole.outerIndexPtr()[column + 1]; ++k)
        if (near[whole.innerIndexPtr()[k]]) values[k] += whole.valuePtr()[k];
  }

  /// Unknowns, among the n coordinates and then the m multipliers, of the part of the tangent that changes
  /// most often: elements that move over the material, with the unknowns that constraints tie to them. The
  /// other unknowns must give a regular matrix. Empty where no part changes more often, or the part is not
  /// small.
  virtual const std::vector<int>& moving_unknowns() const {
    static const std::vector<int> none;
    return none;
  }
  /// (p x p) The share of the moving part in `tangent`, its rows and columns in the order of
  /// moving_unknowns().
  virtual void moving_tangent(const State&, const TangentWeights&, Eigen::MatrixXd& part) const {
    part.resize(0, 0);
  }

  /// Whether G is equal in all states.
  virtual bool has_constant_constraints() const { return constraint_count() == 0; }
  /// speeds (m) = G v + dg/dt in the rows whose gradient turns; in other rows the same or 0.
  virtual void turning_speeds(const State& state, Eigen::Ref<Eigen::VectorXd> speeds) const {
    speeds = constraint_product(state, state.v) + constraint_rate(state);
  }
  /// (m) dg/dt at fixed q: a consistent velocity satisfies G v + rate = 0.
  virtual Eigen::VectorXd constraint_rate(const State& state) const = 0;
  /// (m) G x, x (n).
  virtual Eigen::VectorXd constraint_product(const State& state, const Eigen::VectorXd& x) const {
    Eigen::SparseMatrix<double> gradient = tangent_pattern().matrix();
    tangent(state, {}, gradient);
    Eigen::VectorXd padded = Eigen::VectorXd::Zero(gradient.cols());
    padded.head(x.size()) = x;
    return (gradient * padded).tail(constraint_count());
  }
  /// (m) d2g/dt2 without G a: a consistent acceleration satisfies G a + curvature = 0.
  virtual Eigen::VectorXd constraint_curvature(const State& state) const = 0;

  /// The memory of forces after a step that ends in `state`; state.memory is that of the step's start.
  virtual Eigen::VectorXd committed(const State& state) const { return state.memory; }
  /// Whether forces depend on the multipliers other than by G'lambda; the tangent's columns of multipliers
  /// then contain it.
  virtual bool forces_depend_on_multipliers() const { return false; }
  /// Whether dF/da is equal in all states and dF/dv is zero: nothing moves over material, nothing is damped.
  virtual bool has_constant_inertia() const { return false; }

  /// Longest step allowed from this state [s], for methods with one evaluation at the end of a step; methods
  /// with stages may take half as much more.
  virtual double step_limit(const State&) const { return std::numeric_limits<double>::infinity(); }
  /// Whether the configuration is possible (no element turned inside out); an integrator shortens its step
  /// rather than accept an inadmissible state.
  virtual bool admissible(const State&) const { return true; }
  /// (n) a typical size of each coordinate, > 0, for error control.
  virtual Eigen::VectorXd coordinate_scale() const { return Eigen::VectorXd::Ones(coordinate_count()); }
};

}  // namespace nurbeam
