#include "python/turns.h"

#include <chrono>

#include "python/interpreter_lock.h"

namespace nurbeam::python {

void Turns::begin() {
  using namespace std::chrono_literals;
  std::unique_lock lock(mutex_);
  const unsigned long number = given_++;
  while (!changed_.wait_for(lock, 50ms, [&] { return served_ == number; })) {
    lock.unlock();
    stop_where_the_interpreter_ends();
    lock.lock();
  }
  owner_ = std::this_thread::get_id();
}

void Turns::end() {
  owner_ = std::thread::id();
  const std::lock_guard lock(mutex_);
  ++served_;
  changed_.notify_all();
}

}  // namespace nurbeam::python
