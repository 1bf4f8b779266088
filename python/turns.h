#pragma once
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace nurbeam::python {

/// Threads that take turns, first come, first served.
class Turns {
 public:
  /// Waits for the turn of this thread, which does not hold the interpreter's lock.
  void begin();
  void end();
  /// Whether it is this thread's turn.
  bool is_mine() const { return owner_.load() == std::this_thread::get_id(); }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  unsigned long given_ = 0, served_ = 0;
  std::atomic<std::thread::id> owner_;
};

}  // namespace nurbeam::python
