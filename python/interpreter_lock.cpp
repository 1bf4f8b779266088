#include "python/interpreter_lock.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace nurbeam::python {

namespace {

namespace py = pybind11;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

std::atomic<int> threads_under_way = 0;
std::atomic<bool> interpreter_ends = false;
std::atomic<std::thread::id> ending_thread;  // which goes on
thread_local int depth = 0;                  // of this thread's UnderWay

bool is_to_stop() { return interpreter_ends && ending_thread.load() != std::this_thread::get_id(); }

// Called by Python before it ends, while other threads still can get the lock. A thread that is in a law
// without end, or in one long step, is not waited for.
void end_threads() {
  constexpr auto longest = 5s;
  const py::gil_scoped_release others_go_on;
  ending_thread = std::this_thread::get_id();
  interpreter_ends = true;
  const Clock::time_point start = Clock::now();
  while (threads_under_way > 0 && Clock::now() - start < longest) std::this_thread::sleep_for(1ms);
}

}  // namespace

void stop_where_the_interpreter_ends() {
  if (!is_to_stop()) return;
  if (depth > 0) --threads_under_way;
  for (;;) std::this_thread::sleep_for(1h);
}

UnderWay::UnderWay() {
  if (depth++ == 0) ++threads_under_way;
}

UnderWay::~UnderWay() {
  if (--depth == 0) --threads_under_way;
}

WithoutLock::WithoutLock() : thread_(PyEval_SaveThread()) { stop_where_the_interpreter_ends(); }

WithoutLock::~WithoutLock() {
  stop_where_the_interpreter_ends();
  PyEval_RestoreThread(thread_);
}

WithLock::Entrance::Entrance() {
  if (PyGILState_Check() == 0) stop_where_the_interpreter_ends();
}

WithLock::WithLock() = default;

void watch_the_interpreters_end() {
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_threads));
}

}  // namespace nurbeam::python
