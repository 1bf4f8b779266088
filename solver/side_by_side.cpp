#include "solver/side_by_side.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <utility>

namespace nurbeam {

struct ThreadLimit::Implementation {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int most)
    : implementation_(new Implementation{
          {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(std::max(1, most))}}) {}
ThreadLimit::~ThreadLimit() = default;

struct Alongside::Implementation {
  tbb::task_group work;
};

Alongside::Alongside() : implementation_(new Implementation) {}
Alongside::~Alongside() {
  implementation_->work.cancel();
  implementation_->work.wait();
}
void Alongside::begin(std::function<void()> work) { implementation_->work.run(std::move(work)); }
void Alongside::finish() { implementation_->work.wait(); }

void side_by_side(int count, void (*work)(const void* context, int i), const void* context) {
  tbb::parallel_for(
      0, count, [=](int i) { work(context, i); });
}

}  // namespace nurbeam
