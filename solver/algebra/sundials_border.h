#pragma once
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <Eigen/Core>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

/// The border to SUNDIALS: owners, views, and no exception in a C frame.
namespace nurbeam::sundials {

struct Delete {
  void operator()(_SUNContext* context) const { SUNContext_Free(&context); }
  void operator()(_generic_N_Vector* vector) const { N_VDestroy(vector); }
  void operator()(_generic_SUNMatrix* matrix) const { SUNMatDestroy(matrix); }
  void operator()(_generic_SUNLinearSolver* solver) const { SUNLinSolFree(solver); }
};
template <class T>
using Owner = std::unique_ptr<T, Delete>;

/// `pointer`, which a constructor of SUNDIALS returned; throws std::bad_alloc when it is null.
template <class T>
T* owned(T* pointer) {
  if (!pointer) throw std::bad_alloc();
  return pointer;
}

inline SUNContext new_context() {
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  return owned(context);
}

/// Throws std::logic_error unless `flag`, the return value of a setter, is success: its arguments are our
/// own.
inline void check(int flag, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  if (flag == 0) return;
  throw std::logic_error("SUNDIALS refuses what " + std::string(file) + ":" + std::to_string(line) +
                         " sets, with flag " + std::to_string(flag));
}

inline Eigen::Map<Eigen::VectorXd> map(N_Vector vector) { return {NV_DATA_S(vector), NV_LENGTH_S(vector)}; }

/// An error handler that prints nothing.
inline void ignore_message(int, const char*, const char*, char*, void*) {}

/// Keeps the exceptions of callbacks until the C frames are left.
class Guard {
 public:
  /// Runs `evaluate`, which returns whether it succeeded: 0, 1 (recoverable) or, when it throws, -1.
  template <class Evaluate>
  int run(Evaluate evaluate) noexcept {
    try {
      return evaluate() ? 0 : 1;
    } catch (...) {
      error_ = std::current_exception();
      return -1;
    }
  }
  void rethrow() {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  std::exception_ptr error_;
};

}  // namespace nurbeam::sundials
