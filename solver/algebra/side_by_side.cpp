#include "solver/algebra/side_by_side.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <deque>
#include <exception>
#include <mutex>
#include <utility>

namespace nurbeam {

struct ThreadLimit::Implementation {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int most)
    : implementation_(new Implementation{
          {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(std::max(1, most))}}) {}
ThreadLimit::~ThreadLimit() = default;

// The pieces that wait. A task does them one after another until there is none.
struct Alongside::Implementation {
  std::mutex mutex;
  std::deque<std::function<void()>> waiting;
  std::exception_ptr problem;
  bool is_going = false;
  tbb::task_group task;

  std::function<void()> next() {
    const std::scoped_lock lock(mutex);
    if (problem) waiting.clear();
    is_going = !waiting.empty();
    if (!is_going) return {};
    std::function<void()> work = std::move(waiting.front());
    waiting.pop_front();
    return work;
  }

  void do_all() {
    while (const std::function<void()> work = next()) try {
        work();
      } catch (...) {
        problem = std::current_exception();
      }
  }
};

Alongside::Alongside() : implementation_(new Implementation) {}

Alongside::~Alongside() {
  {
    const std::scoped_lock lock(implementation_->mutex);
    implementation_->waiting.clear();
  }
  implementation_->task.wait();
}

void Alongside::add(std::function<void()> work) {
  Implementation& of = *implementation_;
  {
    const std::scoped_lock lock(of.mutex);
    of.waiting.push_back(std::move(work));
    if (std::exchange(of.is_going, true)) return;
  }
  if (tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) > 1)
    of.task.run([&of] { of.do_all(); });
  else
    of.do_all();
}

void Alongside::finish() {
  implementation_->task.wait();
  if (const std::exception_ptr problem = std::exchange(implementation_->problem, nullptr))
    std::rethrow_exception(problem);
}

void side_by_side(int count, void (*work)(const void* context, int i), const void* context) {
  tbb::parallel_for(
      0, count, [=](int i) { work(context, i); });
}

}  // namespace nurbeam
