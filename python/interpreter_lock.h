#pragma once
#include <pybind11/pybind11.h>

/// Python's interpreter lock, as pybind11's gil_scoped_release and gil_scoped_acquire hold it, for threads
/// that may outlive the interpreter: Python ends a thread that asks for the lock when the interpreter has
/// ended, which C++ cannot survive. Such threads wait here for the end of the process instead.
namespace nurbeam::python {

/// Called by a thread without the lock: does not return once the interpreter ends.
void stop_where_the_interpreter_ends();

/// A thread in C++ that takes the lock later, for as long as this lives: the interpreter's end waits for it.
class UnderWay {
 public:
  UnderWay();
  ~UnderWay();
  UnderWay(const UnderWay&) = delete;
  UnderWay& operator=(const UnderWay&) = delete;
};

/// While it lives Python goes on in other threads. Precondition: the lock is held.
class WithoutLock {
 public:
  WithoutLock();
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

 private:
  UnderWay under_way_;
  PyThreadState* thread_;
};

/// While it lives the lock is held, by a thread that may hold it already.
class WithLock {
 public:
  WithLock();
  WithLock(const WithLock&) = delete;
  WithLock& operator=(const WithLock&) = delete;

 private:
  /// What must be asked before the lock is taken.
  struct Entrance {
    Entrance();
  };
  UnderWay under_way_;
  Entrance entrance_;
  pybind11::gil_scoped_acquire lock_;
};

/// Makes the interpreter's end wait until no thread of ours would ask for its lock any more.
void watch_the_interpreters_end();

}  // namespace nurbeam::python
