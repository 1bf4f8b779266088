#pragma once
#include <kinsol/kinsol.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>

#include "solver/algebra/sundials_border.h"
#include "solver/system/scaled_equations.h"

namespace nurbeam {

/// The KINSOL border: owns its objects, keeps exceptions out of its frames, prints nothing.
class Kinsol {
 public:
  using Matrix = Eigen::SparseMatrix<double>;
  using Vector = Eigen::VectorXd;

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

  /// Improves x until no scaled residual exceeds its `allowed` value, or no further progress is made. Returns
  /// the number of iterations.
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
  /// Weight of the multipliers in the length of a Newton step.
  static constexpr double multiplier_weight = 1e-6;

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

}  // namespace nurbeam
