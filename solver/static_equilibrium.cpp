#include "solver/static_equilibrium.h"

#include <kinsol/kinsol.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/kkt_solver.h"
#include "solver/sundials_border.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

constexpr double round_off = 8 * std::numeric_limits<double>::epsilon();
constexpr double multiplier_weight = 1e-6;   ///< of the multipliers in the length of a Newton step
constexpr double largest_change = 1;         ///< of a coordinate in one increment, over its scale
constexpr double settled_change = 0.05;      ///< in a proximal step, from which plain Newton is tried
constexpr double proximal_tolerance = 1e-6;  ///< on the scaled residual of a proximal step
constexpr double first_increment = 0.1;
constexpr double smallest_increment = 1e-3;
constexpr int easy_iterations = 6;
constexpr int proximal_iterations = 15;

/// The equations in scaled unknowns x = (q / coordinate scale, lambda / multiplier scale) and scaled rows.
///
/// With proximity p > 0 and its centre q_k the dynamics are those with a = p (q - q_k), v = 0.
class ScaledEquations {
 public:
  ScaledEquations(const SecondOrderSystem& system, const State& start)
      : system_(system),
        n_(system.coordinate_count()),
        m_(system.constraint_count()),
        state_(start),
        tangent_(system.tangent_pattern()),
        unknown_scale_(Vector::Ones(n_ + m_)),
        row_factor_(Vector::Ones(n_ + m_)) {
    state_.v.setZero(n_);
    state_.a.setZero(n_);
    unknown_scale_.head(n_) = system.coordinate_scale();
  }

  int size() const { return n_ + m_; }
  int coordinates() const { return n_; }
  const Matrix& tangent() const { return tangent_; }

  /// Scales for forces of the size `work` over coordinate scale, and constraints as large as `state` makes
  /// them.
  void rescale(const State& state, double work) {
    evaluate_tangent(state, {.stiffness = 1});
    Vector constraint_size = Vector::Zero(m_);
    for (int column = 0; column < n_; ++column)
      for (Matrix::InnerIterator entry(tangent_, column); entry; ++entry)
        if (entry.row() >= n_)
          constraint_size[entry.row() - n_] += std::abs(entry.value()) * unknown_scale_[column];
    constraint_size = (constraint_size.array() > 0).select(constraint_size, 1.0);
    row_factor_.head(n_) = unknown_scale_.head(n_) / work;
    row_factor_.tail(m_) = constraint_size.cwiseInverse();
    unknown_scale_.tail(m_) = work * constraint_size.cwiseInverse();
  }

  /// The largest work of inertia over coordinate scale per unit of proximity.
  double inertial_work(const State& state) {
    evaluate_tangent(state, {.mass = 1});
    const Vector diagonal = tangent_.diagonal().head(n_);
    return (diagonal.array() * unknown_scale_.head(n_).array().square()).maxCoeff();
  }

  void set_proximity(double proximity, const Vector& centre) {
    proximity_ = proximity;
    centre_ = centre;
  }
  void clear_proximity() { set_proximity(0, Vector::Zero(n_)); }

  Vector scaled_unknowns(const State& state) const {
    Vector x(size());
    x << state.q, state.lambda;
    return x.cwiseQuotient(unknown_scale_);
  }

  /// The state of scaled unknowns, with the acceleration of the proximity.
  const State& state_of(const Eigen::Ref<const Vector>& x) {
    state_.q = x.head(n_).cwiseProduct(unknown_scale_.head(n_));
    state_.lambda = x.tail(m_).cwiseProduct(unknown_scale_.tail(m_));
    if (proximity_ > 0)
      state_.a = proximity_ * (state_.q - centre_);
    else
      state_.a.setZero();
    return state_;
  }

  /// Whether `rows`, the scaled residual at `x`, is one of an admissible configuration and finite.
  [[nodiscard]] bool evaluate(const Eigen::Ref<const Vector>& x, Eigen::Ref<Vector> rows) {
    const State& state = state_of(x);
    if (!x.allFinite() || !system_.admissible(state)) return false;
    system_.residual(state, rows.head(n_), rows.tail(m_));
    rows = rows.cwiseProduct(row_factor_);
    return rows.allFinite();
  }

  /// Puts the scaled derivative of the rows at `x` into tangent(); returns whether it is finite.
  [[nodiscard]] bool differentiate(const Eigen::Ref<const Vector>& x) {
    evaluate_tangent(state_of(x), {.mass = proximity_, .stiffness = 1});
    for (int column = 0; column < size(); ++column)
      for (Matrix::InnerIterator entry(tangent_, column); entry; ++entry)
        entry.valueRef() *= row_factor_[entry.row()] * unknown_scale_[column];
    return tangent_.coeffs().allFinite();
  }

  /// Largest scaled residual at `x` and what each may be: `tolerance` and its own round-off; a residual that
  /// cannot be evaluated is infinite.
  struct Quality {
    Vector allowed;
    double residual_norm = std::numeric_limits<double>::infinity();
    bool acceptable = false;
  };
  Quality quality(const Vector& x, double tolerance) {
    Vector rows(size());
    Vector allowed = Vector::Constant(size(), tolerance);
    if (!evaluate(x, rows) || !differentiate(x)) return {.allowed = allowed};
    for (int column = 0; column < size(); ++column)
      for (Matrix::InnerIterator entry(tangent_, column); entry; ++entry)
        allowed[entry.row()] += round_off * std::abs(entry.value()) * (std::abs(x[column]) + 1);
    return {allowed, rows.lpNorm<Eigen::Infinity>(), (rows.cwiseAbs().array() <= allowed.array()).all()};
  }

 private:
  void evaluate_tangent(const State& state, const TangentWeights& weights) {
    system_.tangent(state, weights, tangent_);
  }

  const SecondOrderSystem& system_;
  int n_;
  int m_;
  State state_;
  Matrix tangent_;
  Vector unknown_scale_;
  Vector row_factor_;
  double proximity_ = 0;
  Vector centre_;
};

/// The KINSOL border: owns its objects, keeps exceptions out of its frames, prints nothing.
class Kinsol {
 public:
  explicit Kinsol(ScaledEquations& equations) : equations_(equations) {
    const sunindextype size = equations.size();
    context_.reset(sundials::new_context());
    x_.reset(sundials::owned(N_VNew_Serial(size, context_.get())));
    unknown_weight_.reset(sundials::owned(N_VNew_Serial(size, context_.get())));
    row_weight_.reset(sundials::owned(N_VNew_Serial(size, context_.get())));
    matrix_.reset(sundials::owned(
        SUNSparseMatrix(size, size, equations.tangent().nonZeros(), CSC_MAT, context_.get())));
    linear_solver_.reset(sundials::owned(SUNLinSol_KLU(x_.get(), matrix_.get(), context_.get())));
    memory_.reset(static_cast<KINMemory*>(sundials::owned(KINCreate(context_.get()))));
    sundials::map(unknown_weight_.get())
        .setConstant(multiplier_weight)
        .head(equations.coordinates())
        .setOnes();
    KINSetErrHandlerFn(memory(), sundials::ignore_message, nullptr);
    KINSetUserData(memory(), this);
    sundials::check(KINInit(memory(), residual, x_.get()));
    sundials::check(KINSetLinearSolver(memory(), linear_solver_.get(), matrix_.get()));
    sundials::check(KINSetJacFn(memory(), jacobian));
    sundials::check(KINSetMaxSetupCalls(memory(), 1));
    sundials::check(KINSetScaledStepTol(memory(), std::numeric_limits<double>::epsilon()));
    sundials::check(KINSetMaxNewtonStep(memory(), std::sqrt(static_cast<double>(equations.coordinates()))));
  }

  /// Improves x until no scaled residual is above the `allowed` one or no further progress is made.
  /// Returns the number of iterations.
  int improve(Vector& x, const Vector& allowed, int strategy, int max_iterations) {
    sundials::map(x_.get()) = x;
    sundials::map(row_weight_.get()) = allowed.minCoeff() * allowed.cwiseInverse();
    sundials::check(KINSetFuncNormTol(memory(), allowed.minCoeff()));
    sundials::check(KINSetNumMaxIters(memory(), max_iterations));
    // A failed factorisation must not be refactorised.
    sundials::check(SUNLinSol_KLUReInit(linear_solver_.get(), matrix_.get(),
                                        SUNSparseMatrix_NNZ(matrix_.get()), SUNKLU_REINIT_PARTIAL));
    const int flag = KINSol(memory(), x_.get(), strategy, unknown_weight_.get(), row_weight_.get());
    guard_.rethrow();
    if (flag == KIN_MEM_FAIL) throw std::bad_alloc();
    x = sundials::map(x_.get());
    long iterations = 0;
    KINGetNumNonlinSolvIters(memory(), &iterations);
    return static_cast<int>(iterations);
  }

 private:
  struct KINMemory;
  struct DeleteMemory {
    void operator()(KINMemory* memory) const {
      void* pointer = memory;
      KINFree(&pointer);
    }
  };
  void* memory() const { return memory_.get(); }

  static int residual(N_Vector x, N_Vector rows, void* data) {
    Kinsol& self = *static_cast<Kinsol*>(data);
    return self.guard_.run([&] { return self.equations_.evaluate(sundials::map(x), sundials::map(rows)); });
  }

  static int jacobian(N_Vector x, N_Vector, SUNMatrix matrix, void* data, N_Vector, N_Vector) {
    Kinsol& self = *static_cast<Kinsol*>(data);
    return self.guard_.run([&] {
      const bool finite = self.equations_.differentiate(sundials::map(x));
      const Matrix& tangent = self.equations_.tangent();
      std::copy_n(tangent.outerIndexPtr(), tangent.cols() + 1, SUNSparseMatrix_IndexPointers(matrix));
      std::copy_n(tangent.innerIndexPtr(), tangent.nonZeros(), SUNSparseMatrix_IndexValues(matrix));
      std::copy_n(tangent.valuePtr(), tangent.nonZeros(), SUNSparseMatrix_Data(matrix));
      return finite;
    });
  }

  ScaledEquations& equations_;
  sundials::Guard guard_;
  sundials::Owner<_SUNContext> context_;
  sundials::Owner<_generic_N_Vector> x_;
  sundials::Owner<_generic_N_Vector> unknown_weight_;
  sundials::Owner<_generic_N_Vector> row_weight_;
  sundials::Owner<_generic_SUNMatrix> matrix_;
  sundials::Owner<_generic_SUNLinearSolver> linear_solver_;
  std::unique_ptr<KINMemory, DeleteMemory> memory_;
};

/// One search: the state and load factor of the last equilibrium, and what was spent so far.
class EquilibriumSearch {
 public:
  EquilibriumSearch(const StaticEquilibrium& settings, const SecondOrderSystem& system,
                    const std::function<void(double)>& set_load_factor, const State& start)
      : settings_(settings),
        system_(system),
        set_load_factor_(set_load_factor),
        scale_(system.coordinate_scale()),
        state_(at_rest(start, system)),
        equations_(system, state_),
        kinsol_(equations_) {}

  StaticReport run() {
    if (!reach(1).converged && (reach(0).converged || relax(0))) follow_load();
    set_load_factor_(report_.load_factor);
    return report_;
  }

  const State& state() const { return state_; }

 private:
  struct Outcome {
    bool converged = false;
    bool singular_at_start = false;
    int iterations = 0;
    double residual_norm = 0;
  };

  static State at_rest(State state, const SecondOrderSystem& system) {
    state.v.setZero(system.coordinate_count());
    state.a.setZero(system.coordinate_count());
    if (state.lambda.size() != system.constraint_count()) state.lambda.setZero(system.constraint_count());
    return state;
  }

  /// Applies the load in increments from the equilibrium without load.
  void follow_load() {
    double increment = first_increment;
    while (report_.status != StaticStatus::converged && steps_left()) {
      const double factor = std::min(1.0, report_.load_factor + increment);
      const Outcome outcome = reach(factor);
      if (outcome.converged) {
        if (outcome.iterations <= easy_iterations) increment *= 2;
      } else if (increment > smallest_increment && !outcome.singular_at_start) {
        increment /= 2;
      } else if (relax(factor)) {
        increment = first_increment;
      } else {
        return;
      }
    }
  }

  /// Newton at a load factor from the last equilibrium, within the bound on the change. From a singular
  /// tangent its direction means nothing, and so does the equilibrium it may end in.
  Outcome reach(double factor) {
    ++report_.load_steps;
    State trial = state_;
    Outcome outcome = newton(factor, trial);
    outcome.converged =
        outcome.converged && !outcome.singular_at_start && change(trial, state_) <= largest_change;
    if (outcome.converged) accept(factor, trial, outcome);
    return outcome;
  }

  /// Proximal steps at a load factor from the last equilibrium until plain Newton converges nearby.
  bool relax(double factor) {
    set_load_factor_(factor);
    State centre = state_;
    const double inertia = equations_.inertial_work(centre);
    if (!(inertia > 0)) return false;
    double proximity = 10 * largest_force(factor, centre) / inertia;
    while (steps_left()) {
      ++report_.load_steps;
      State trial = centre;
      const Outcome step = proximal_step(factor, proximity, trial);
      const double moved = change(trial, centre);
      if (!step.converged || !(moved <= largest_change)) {
        proximity *= 10;
        continue;
      }
      centre = trial;
      const Outcome settled = moved <= settled_change ? newton(factor, trial) : Outcome{};
      if (settled.converged && change(trial, centre) <= largest_change) {
        accept(factor, trial, settled);
        return true;
      }
      proximity *= step.iterations <= easy_iterations ? 0.2 : 0.5;
    }
    return false;
  }

  /// Solves the equilibrium at `factor` from `trial`, in place; rescaled as the multipliers become known.
  ///
  /// Full Newton steps come first: where stiff members turn, a line search would follow them in tiny steps.
  Outcome newton(double factor, State& trial) {
    constexpr std::array strategies = {KIN_NONE, KIN_LINESEARCH, KIN_LINESEARCH};
    set_load_factor_(factor);
    equations_.clear_proximity();
    equations_.rescale(trial, largest_force(factor, trial));
    auto quality = equations_.quality(equations_.scaled_unknowns(trial), settings_.tolerance);
    Outcome outcome{.converged = quality.residual_norm <= settings_.tolerance,
                    .residual_norm = quality.residual_norm};
    if (!outcome.converged) outcome.singular_at_start = !kkt_solver_.factorise(equations_.tangent());
    for (const int strategy : strategies) {
      if (outcome.converged) break;
      Vector x = equations_.scaled_unknowns(trial);
      improve(x, quality.allowed, strategy, settings_.max_iterations, outcome);
      const bool better = equations_.quality(x, settings_.tolerance).residual_norm <= outcome.residual_norm;
      if (better) trial = equations_.state_of(x);
      equations_.rescale(trial, largest_force(factor, trial));
      quality = equations_.quality(equations_.scaled_unknowns(trial), settings_.tolerance);
      outcome.residual_norm = quality.residual_norm;
      outcome.converged = quality.acceptable;
    }
    report_.status = outcome.singular_at_start ? StaticStatus::singular_matrix : StaticStatus::not_converged;
    report_.residual_norm = outcome.residual_norm;
    return outcome;
  }

  /// Solves M(q)(q - q_k) proximity - f + G'lambda = 0 from q_k = trial.q, in place.
  Outcome proximal_step(double factor, double proximity, State& trial) {
    equations_.rescale(trial, largest_force(factor, trial));
    equations_.set_proximity(proximity, trial.q);
    Vector x = equations_.scaled_unknowns(trial);
    Outcome outcome;
    improve(x, Vector::Constant(x.size(), proximal_tolerance), KIN_NONE, proximal_iterations, outcome);
    outcome.converged = equations_.quality(x, proximal_tolerance).acceptable;
    trial = equations_.state_of(x);
    equations_.clear_proximity();
    return outcome;
  }

  void improve(Vector& x, const Vector& allowed, int strategy, int max_iterations, Outcome& outcome) {
    const int iterations = kinsol_.improve(x, allowed, strategy, max_iterations);
    outcome.iterations += iterations;
    report_.newton_iterations += iterations;
  }

  /// The largest of full load and constraint force, else of the unbalanced internal force, else 1; each as
  /// work over coordinate scale. Leaves the load at `factor`.
  double largest_force(double factor, const State& state) const {
    State free = at_rest(state, system_);
    const Vector with_multipliers = dynamics(free);
    free.lambda.setZero();
    const Vector without_multipliers = dynamics(free);
    set_load_factor_(0);
    const Vector unloaded = dynamics(free);
    set_load_factor_(1);
    const Vector loaded = dynamics(free);
    set_load_factor_(factor);
    const double applied = std::max(work(loaded - unloaded), work(with_multipliers - without_multipliers));
    if (applied > 0) return applied;
    return work(unloaded) > 0 ? work(unloaded) : 1;
  }

  Vector dynamics(const State& state) const {
    Vector rows(system_.coordinate_count());
    Vector constraints(system_.constraint_count());
    system_.residual(state, rows, constraints);
    return rows;
  }

  double work(const Vector& force) const { return force.cwiseProduct(scale_).lpNorm<Eigen::Infinity>(); }

  double change(const State& a, const State& b) const {
    return (a.q - b.q).cwiseQuotient(scale_).lpNorm<Eigen::Infinity>();
  }

  void accept(double factor, const State& equilibrium, const Outcome& outcome) {
    state_ = at_rest(equilibrium, system_);
    report_.load_factor = factor;
    report_.residual_norm = outcome.residual_norm;
    report_.status = factor == 1 ? StaticStatus::converged : StaticStatus::not_converged;
  }

  bool steps_left() const { return report_.load_steps < settings_.max_load_steps; }

  const StaticEquilibrium& settings_;
  const SecondOrderSystem& system_;
  const std::function<void(double)>& set_load_factor_;
  Vector scale_;
  State state_;
  StaticReport report_;
  ScaledEquations equations_;
  Kinsol kinsol_;
  KktSolver kkt_solver_;
};

void require(bool rule, const std::string& message) {
  if (!rule) throw std::invalid_argument("static equilibrium: " + message);
}

}  // namespace

StaticReport find_static_equilibrium(const StaticEquilibrium& settings, const SecondOrderSystem& system,
                                     const std::function<void(double)>& set_load_factor, State& state) {
  require(settings.tolerance > 0, "tolerance " + std::to_string(settings.tolerance) + " is not positive");
  require(settings.max_iterations > 0,
          "max_iterations " + std::to_string(settings.max_iterations) + " is not positive");
  require(state.q.size() == system.coordinate_count(), "q has " + std::to_string(state.q.size()) +
                                                           " entries, the system " +
                                                           std::to_string(system.coordinate_count()));
  EquilibriumSearch search(settings, system, set_load_factor, state);
  const StaticReport report = search.run();
  state = search.state();
  return report;
}

}  // namespace nurbeam
