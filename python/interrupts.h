#pragma once
#include <pybind11/pybind11.h>

#include <optional>

namespace nurbeam::python {

/// Asks Python whether Ctrl-C has been pressed; where it has, keeps the exception until it can be thrown.
class Interrupts {
 public:
  /// Whether there is an exception. Takes the interpreter's lock.
  bool pending() {
    const pybind11::gil_scoped_acquire lock;
    if (!exception_ && PyErr_CheckSignals() != 0) exception_.emplace();
    return exception_.has_value();
  }
  /// Precondition: the interpreter's lock is held.
  void rethrow() {
    if (!exception_) return;
    const pybind11::error_already_set exception = *exception_;
    exception_.reset();
    throw exception;
  }

 private:
  std::optional<pybind11::error_already_set> exception_;
};

}  // namespace nurbeam::python
