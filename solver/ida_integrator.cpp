#include "solver/ida_integrator.h"

#include <ida/ida.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/kkt_solver.h"
#include "solver/mass_scale.h"
#include "solver/sundials_border.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using VectorRef = Eigen::Ref<Vector>;
using ConstVectorRef = Eigen::Ref<const Vector>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double shortest_step = 16 * epsilon;  ///< over |t|
/// Of the local error that Newton's iteration may leave; with IDA's 0.33 that rest passes for an error of the
/// formula in the estimates, and twice the steps are taken.
constexpr double newton_fraction = 0.01;

void require(bool rule, const std::string& message) {
  if (!rule) throw std::invalid_argument("IDA: " + message);
}

void check_size(const char* name, Eigen::Index size, Eigen::Index expected) {
  require(size == expected, std::string(name) + " has " + std::to_string(size) + " entries, the system " +
                                std::to_string(expected));
}

/// The stabilised equations in unknowns and rows of order one.
///
/// With s the coordinate scale, T the time scale, E = max M_jj s_j^2 and c_k = sum |G_kj| s_j at the start:
/// q = s x, v = s w / T, lambda = E / (c T^2) l, mu = m / (c T); y = (x, w, l, m). Rows, with H_kj = G_kj s_j
/// / c_k:
///
///   T x' - w - H'm,   T^2 s / E (M v' - f + G'lambda),   g / c,   T / c (G v + g_t).
class StabilisedEquations {
 public:
  StabilisedEquations(const SecondOrderSystem& system, const State& start, double time_scale)
      : system_(system),
        n_(system.coordinate_count()),
        m_(system.constraint_count()),
        T_(time_scale),
        s_(system.coordinate_scale()),
        state_(start),
        tangent_(system.tangent_pattern()),
        inertia_(tangent_),
        dynamics_(n_),
        constraints_(m_),
        padded_(Vector::Zero(n_ + m_)) {
    system.tangent(start, {.mass = 1}, tangent_);
    const Vector inertia = tangent_.diagonal().head(n_).cwiseProduct(s_.cwiseAbs2());
    const double E = n_ > 0 ? inertia.maxCoeff() : 1;
    work_ = E > 0 && std::isfinite(E) ? E : 1;
    c_ = Vector::Zero(m_);
    for (int j = 0; j < n_; ++j)
      for (Matrix::InnerIterator entry(tangent_, j); entry; ++entry)
        if (entry.row() >= n_) c_[entry.row() - n_] += std::abs(entry.value()) * s_[j];
    for (double& c : c_) c = c > 0 && std::isfinite(c) ? c : 1;
  }

  int size() const { return 2 * (n_ + m_); }
  int differential_count() const { return 2 * n_; }

  /// Whether M on the null space of G, and G, are regular at `state`: without it l and m are not determined.
  bool regular(const State& state) {
    const double scale = mass_scale(system_, state, tangent_);
    system_.tangent(state, {.mass = 1 / scale}, tangent_);
    return KktSolver().factorise(tangent_);
  }

  void write(const State& state, VectorRef y, VectorRef derivative) const {
    y.head(n_) = state.q.cwiseQuotient(s_);
    y.segment(n_, n_) = T_ * state.v.cwiseQuotient(s_);
    y.segment(2 * n_, m_) = T_ * T_ / work_ * c_.cwiseProduct(state.lambda);
    y.tail(m_).setZero();
    derivative.setZero();
    derivative.head(n_) = state.v.cwiseQuotient(s_);
    derivative.segment(n_, n_) = T_ * state.a.cwiseQuotient(s_);
  }

  void read(double t, const ConstVectorRef& y, const ConstVectorRef& derivative, State& state) const {
    state.t = t;
    state.q = s_.cwiseProduct(y.head(n_));
    state.v = s_.cwiseProduct(y.segment(n_, n_)) / T_;
    state.a = s_.cwiseProduct(derivative.segment(n_, n_)) / T_;
    state.lambda = work_ / (T_ * T_) * y.segment(2 * n_, m_).cwiseQuotient(c_);
  }

  enum class Outcome { finite, not_finite, inadmissible };

  Outcome residual(double t, const ConstVectorRef& y, const ConstVectorRef& derivative, VectorRef rows) {
    if (!y.allFinite() || !derivative.allFinite()) return Outcome::not_finite;
    read(t, y, derivative, state_);
    if (!system_.admissible(state_)) return Outcome::inadmissible;
    system_.residual(state_, dynamics_, constraints_);
    rows.head(n_) = T_ * derivative.head(n_) - y.segment(n_, n_);
    rows.segment(n_, n_) = T_ * T_ / work_ * s_.cwiseProduct(dynamics_);
    rows.segment(2 * n_, m_) = constraints_.cwiseQuotient(c_);
    if (m_ > 0) {
      system_.tangent(state_, {}, tangent_);
      padded_.head(n_).setZero();
      padded_.tail(m_) = y.tail(m_).cwiseQuotient(c_);
      rows.head(n_) -= s_.cwiseProduct((tangent_ * padded_).head(n_));
      padded_.head(n_) = state_.v;
      padded_.tail(m_).setZero();
      rows.tail(m_) =
          T_ * ((tangent_ * padded_).tail(m_) + system_.constraint_rate(state_)).cwiseQuotient(c_);
    }
    return rows.allFinite() ? Outcome::finite : Outcome::not_finite;
  }

  /// Entries of the matrix that jacobian() fills.
  int entry_count() const {
    int dynamic_entries = 0;
    int constraint_entries = 0;
    for (int j = 0; j < n_; ++j)
      for (Matrix::InnerIterator entry(tangent_, j); entry; ++entry)
        ++(entry.row() < n_ ? dynamic_entries : constraint_entries);
    return 2 * n_ + 2 * dynamic_entries + 5 * constraint_entries;
  }

  /// Fills `matrix` with d rows/dy + cj d rows/dy'; returns whether it is finite.
  [[nodiscard]] bool jacobian(double t, double cj, const ConstVectorRef& y, const ConstVectorRef& derivative,
                              SUNMatrix matrix) {
    read(t, y, derivative, state_);
    system_.tangent(state_, {.mass = cj, .damping = 1}, inertia_);
    const double fastest = std::max(1.0, y.segment(n_, n_).lpNorm<Eigen::Infinity>());
    const double dt = std::sqrt(epsilon) * T_ / fastest;
    state_.t += dt;
    state_.q += dt * state_.v;
    system_.tangent(state_, {.stiffness = 1}, tangent_);
    if (!inertia_.coeffs().allFinite() || !tangent_.coeffs().allFinite()) return false;

    Columns columns(matrix);
    const auto coordinates = [&](int j, auto visit) {
      Matrix::InnerIterator moved(tangent_, j);
      for (Matrix::InnerIterator entry(inertia_, j); entry; ++entry, ++moved)
        if (entry.row() < n_) visit(static_cast<int>(entry.row()), entry.value(), moved.value());
    };
    const auto constraints = [&](int j, auto visit) {
      Matrix::InnerIterator moved(tangent_, j);
      for (Matrix::InnerIterator entry(inertia_, j); entry; ++entry, ++moved) {
        const int k = static_cast<int>(entry.row()) - n_;
        if (k >= 0) visit(k, entry.value() * s_[j] / c_[k], moved.value() * s_[j] / c_[k]);
      }
    };
    const double force = T_ * T_ / work_;
    for (int j = 0; j < n_; ++j) {  // d/dx_j
      columns.add(j, T_ * cj);
      coordinates(j, [&](int i, double, double K) { columns.add(n_ + i, force * s_[i] * K * s_[j]); });
      constraints(j, [&](int k, double H, double) { columns.add(2 * n_ + k, H); });
      constraints(
          j, [&](int k, double H, double moved) { columns.add(2 * n_ + m_ + k, T_ * (moved - H) / dt); });
      columns.close();
    }
    for (int j = 0; j < n_; ++j) {  // d/dw_j
      columns.add(j, -1);
      coordinates(j, [&](int i, double A, double) { columns.add(n_ + i, force * s_[i] * A * s_[j] / T_); });
      constraints(j, [&](int k, double H, double) { columns.add(2 * n_ + m_ + k, H); });
      columns.close();
    }
    for (const int sign : {1, -1})  // d/dl_k, d/dm_k
      for (int k = 0; k < m_; ++k) {
        for (Matrix::InnerIterator entry(inertia_, n_ + k); entry; ++entry)
          if (entry.row() < n_)
            columns.add((sign > 0 ? n_ : 0) + static_cast<int>(entry.row()),
                        sign * entry.value() * s_[entry.row()] / c_[k]);
        columns.close();
      }
    return true;
  }

 private:
  /// Writes a compressed matrix column by column.
  class Columns {
   public:
    explicit Columns(SUNMatrix matrix)
        : starts_(SUNSparseMatrix_IndexPointers(matrix)),
          rows_(SUNSparseMatrix_IndexValues(matrix)),
          values_(SUNSparseMatrix_Data(matrix)) {
      starts_[0] = 0;
    }
    void add(int row, double value) {
      rows_[count_] = row;
      values_[count_++] = value;
    }
    void close() { starts_[++column_] = count_; }

   private:
    sunindextype* starts_;
    sunindextype* rows_;
    double* values_;
    sunindextype column_ = 0;
    sunindextype count_ = 0;
  };

  const SecondOrderSystem& system_;
  int n_;
  int m_;
  double T_;         ///< [s]
  double work_ = 1;  ///< E
  Vector s_;         ///< (n)
  Vector c_;         ///< (m)
  State state_;
  Matrix tangent_;
  Matrix inertia_;
  Vector dynamics_;
  Vector constraints_;
  Vector padded_;  ///< (n+m)
};

using Outcome = StabilisedEquations::Outcome;

}  // namespace

struct IdaIntegrator::Implementation {
  struct IdaMemory;
  struct DeleteMemory {
    void operator()(IdaMemory* memory) const {
      void* pointer = memory;
      IDAFree(&pointer);
    }
  };

  Implementation(const Ida& options, const SecondOrderSystem& owner, State start)
      : settings(options),
        system(&owner),
        state(std::move(start)),
        trial(state),
        equations(owner, state, options.time_scale) {
    const sunindextype size = equations.size();
    context.reset(sundials::new_context());
    y.reset(sundials::owned(N_VNew_Serial(size, context.get())));
    derivative.reset(sundials::owned(N_VNew_Serial(size, context.get())));
    rows.reset(sundials::owned(N_VNew_Serial(size, context.get())));
    matrix.reset(
        sundials::owned(SUNSparseMatrix(size, size, equations.entry_count(), CSC_MAT, context.get())));
    linear_solver.reset(sundials::owned(SUNLinSol_KLU(y.get(), matrix.get(), context.get())));
    memory.reset(static_cast<IdaMemory*>(sundials::owned(IDACreate(context.get()))));
    void* ida = memory.get();
    IDASetErrHandlerFn(ida, sundials::ignore_message, nullptr);
    equations.write(state, map(y), map(derivative));
    sundials::check(IDAInit(ida, residual, state.t, y.get(), derivative.get()));
    sundials::check(IDASetUserData(ida, this));
    sundials::check(IDAWFtolerances(ida, error_weights));
    sundials::check(IDASetLinearSolver(ida, linear_solver.get(), matrix.get()));
    sundials::check(IDASetJacFn(ida, jacobian));
    sundials::check(IDASetNonlinConvCoef(ida, newton_fraction));
    sundials::check(IDASetMaxOrd(ida, settings.max_order));
    map(rows).setZero();
    map(rows).head(equations.differential_count()).setOnes();
    sundials::check(IDASetId(ida, rows.get()));
    sundials::check(IDASetSuppressAlg(ida, SUNTRUE));
  }

  static Eigen::Map<Vector> map(const sundials::Owner<_generic_N_Vector>& vector) {
    return sundials::map(vector.get());
  }

  bool evaluate(double t, N_Vector unknowns, N_Vector rates, N_Vector result) {
    const Outcome outcome =
        equations.residual(t, sundials::map(unknowns), sundials::map(rates), sundials::map(result));
    if (outcome == Outcome::inadmissible) met_inadmissible = true;
    return outcome == Outcome::finite;
  }

  static int residual(double t, N_Vector unknowns, N_Vector rates, N_Vector result, void* data) {
    Implementation& self = *static_cast<Implementation*>(data);
    return self.guard.run([&] { return self.evaluate(t, unknowns, rates, result); });
  }

  static int jacobian(double t, double cj, N_Vector unknowns, N_Vector rates, N_Vector, SUNMatrix result,
                      void* data, N_Vector, N_Vector, N_Vector) {
    Implementation& self = *static_cast<Implementation*>(data);
    return self.guard.run([&] {
      return self.equations.jacobian(t, cj, sundials::map(unknowns), sundials::map(rates), result);
    });
  }

  /// An error of l or m that moves w or x, over the step, by less than the tolerance does no harm.
  static int error_weights(N_Vector unknowns, N_Vector result, void* data) {
    constexpr double first_step = 1e-9;  // over the time scale, before there is a step
    const Implementation& self = *static_cast<Implementation*>(data);
    const auto y = sundials::map(unknowns);
    auto weights = sundials::map(result);
    const double tolerance = self.settings.tolerance;
    weights = (tolerance * (y.array().abs() + 1)).inverse();
    double h = 0;
    IDAGetCurrentStep(self.memory.get(), &h);
    const double relative = std::max(std::abs(h) / self.settings.time_scale, first_step);
    weights.tail(y.size() - self.equations.differential_count()) *= std::min(1.0, relative);
    return 0;
  }

  StepReport advance(double step) {
    StepReport report{.status = StepStatus::inadmissible, .next_step = step};
    const double end = state.t + step;
    if (!(step > 0) || !std::isfinite(end) || !(end - state.t > shortest_step * std::abs(end))) return report;
    const bool restart = std::exchange(must_restart, true);
    if (restart && !equations.regular(state)) {
      report.status = StepStatus::singular_matrix;
      return report;
    }
    if (restart) start();
    const Counts before = counts();
    report.status = integrate(end);
    const Counts after = counts();
    report.newton_iterations = static_cast<int>(after.newton_iterations - before.newton_iterations);
    report.rejected = static_cast<int>(after.rejected - before.rejected);
    if (report.status != StepStatus::converged) return report;
    report.step = step;
    report.local_error = local_error();
    report.residual_norm = map(rows).lpNorm<Eigen::Infinity>();
    std::swap(state, trial);
    must_restart = false;
    return report;
  }

  /// Puts IDA at the state, without history.
  void start() {
    equations.write(state, map(y), map(derivative));
    trial = state;
    sundials::check(IDAReInit(memory.get(), state.t, y.get(), derivative.get()));
    // A failed factorisation must not be refactorised.
    sundials::check(SUNLinSol_KLUReInit(linear_solver.get(), matrix.get(), SUNSparseMatrix_NNZ(matrix.get()),
                                        SUNKLU_REINIT_PARTIAL));
  }

  /// Steps to `end`; the state there is in `trial`, its residual in `rows`.
  StepStatus integrate(double end) {
    double t = state.t;
    trial = state;
    for (int i = 0; i < settings.max_steps; ++i) {
      const double limit = system->step_limit(trial);
      if (!(limit > shortest_step * std::abs(t))) return StepStatus::inadmissible;
      const double stop = next_stop(t, end, limit);
      if (IDASetStopTime(memory.get(), stop) != IDA_SUCCESS) return StepStatus::not_converged;
      met_inadmissible = false;
      const int flag = IDASolve(memory.get(), stop, &t, y.get(), derivative.get(), IDA_ONE_STEP);
      guard.rethrow();
      if (flag == IDA_MEM_FAIL) throw std::bad_alloc();
      if (flag < 0) return failure();
      if (t >= end) t = end;
      equations.read(t, map(y), map(derivative), trial);
      if (!system->admissible(trial)) return StepStatus::inadmissible;
      if (t < end) continue;
      return evaluate(t, y.get(), derivative.get(), rows.get()) ? StepStatus::converged : failure();
    }
    return StepStatus::not_converged;
  }

  /// Where IDA's next step must end at the latest. A stop is set only where it is needed, since each disturbs
  /// the choice of the order: when the step is longer than the limit, and when what would be left after it is
  /// less than a step, which is then halved.
  double next_stop(double t, double end, double limit) const {
    double h = 0;  // stays so before the first step
    IDAGetCurrentStep(memory.get(), &h);
    const double rest = end - t;
    const double reached = 64 * epsilon * (std::abs(t) + h);  // less is no distance to IDA
    if (!(h > 0 && h <= limit)) {
      const double pieces = std::ceil(rest / limit);
      return pieces <= 1 ? end : t + rest / pieces;
    }
    return rest > h + reached && rest < 2 * h ? t + rest / 2 : end;
  }

  StepStatus failure() {
    if (met_inadmissible) return StepStatus::inadmissible;
    return equations.regular(trial) ? StepStatus::not_converged : StepStatus::singular_matrix;
  }

  struct Counts {
    long newton_iterations = 0;
    long rejected = 0;
  };
  Counts counts() const {
    long iterations = 0;
    long error_failures = 0;
    long solver_failures = 0;
    IDAGetNumNonlinSolvIters(memory.get(), &iterations);
    IDAGetNumErrTestFails(memory.get(), &error_failures);
    IDAGetNumStepSolveFails(memory.get(), &solver_failures);
    return {iterations, error_failures + solver_failures};
  }

  /// Of the last step: largest estimate over q and v in units of the tolerance's own scale.
  double local_error() {
    const sundials::Owner<_generic_N_Vector> estimate(sundials::owned(N_VClone(y.get())));
    sundials::check(IDAGetEstLocalErrors(memory.get(), estimate.get()));
    const auto scale = map(y).cwiseAbs().array() + 1;
    return (map(estimate).array() / scale).head(equations.differential_count()).abs().maxCoeff();
  }

  Ida settings;
  const SecondOrderSystem* system;
  State state;
  State trial;
  StabilisedEquations equations;
  bool must_restart = true;
  bool met_inadmissible = false;  ///< in the step under way
  sundials::Guard guard;
  sundials::Owner<_SUNContext> context;
  sundials::Owner<_generic_N_Vector> y;
  sundials::Owner<_generic_N_Vector> derivative;
  sundials::Owner<_generic_N_Vector> rows;
  sundials::Owner<_generic_SUNMatrix> matrix;
  sundials::Owner<_generic_SUNLinearSolver> linear_solver;
  std::unique_ptr<IdaMemory, DeleteMemory> memory;
};

IdaIntegrator::IdaIntegrator(Ida settings, const SecondOrderSystem& system, State start) {
  require(settings.tolerance > 0, "tolerance " + std::to_string(settings.tolerance) + " is not positive");
  require(settings.time_scale > 0 && std::isfinite(settings.time_scale),
          "time_scale " + std::to_string(settings.time_scale) + " is not positive and finite");
  require(settings.max_order >= 1 && settings.max_order <= 5,
          "max_order " + std::to_string(settings.max_order) + " is not in [1, 5]");
  require(settings.max_steps > 0, "max_steps " + std::to_string(settings.max_steps) + " is not positive");
  check_size("q", start.q.size(), system.coordinate_count());
  check_size("v", start.v.size(), system.coordinate_count());
  check_size("a", start.a.size(), system.coordinate_count());
  check_size("lambda", start.lambda.size(), system.constraint_count());
  implementation_ = std::make_unique<Implementation>(settings, system, std::move(start));
}

IdaIntegrator::~IdaIntegrator() = default;
IdaIntegrator::IdaIntegrator(IdaIntegrator&&) noexcept = default;
IdaIntegrator& IdaIntegrator::operator=(IdaIntegrator&&) noexcept = default;

const State& IdaIntegrator::state() const { return implementation_->state; }

StepReport IdaIntegrator::advance(double step) { return implementation_->advance(step); }

long IdaIntegrator::internal_steps() const {
  long steps = 0;
  IDAGetNumSteps(implementation_->memory.get(), &steps);
  return steps;
}

}  // namespace nurbeam
