#pragma once
#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>

#include "python/interpreter_lock.h"

namespace nurbeam::python {

/// Asks Python whether Ctrl-C has been pressed; where it has, keeps the exception until it can be thrown.
class Interrupts {
 public:
  /// Whether there is an exception. Takes the interpreter's lock, for which other threads may make it wait,
  /// and so looks 20 times a second.
  bool pending() {
    stop_where_the_interpreter_ends();
    const Clock::time_point now = Clock::now();
    if (exception_ || now - asked_ < std::chrono::milliseconds(50)) return exception_.has_value();
    asked_ = now;
    const WithLock lock;
    if (PyErr_CheckSignals() != 0) exception_.emplace();
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
  using Clock = std::chrono::steady_clock;

  Clock::time_point asked_;
  std::optional<pybind11::error_already_set> exception_;
};

}  // namespace nurbeam::python
