#include <poll.h>

#include <algorithm>

#include "pipelines/study/engine.h"
#include "pipelines/study/process_worker.h"

namespace nurbeam {

namespace {

class ProcessPool : public StudyEngine {
 public:
  ProcessPool(const WorkerCommand& command, int workers, std::optional<double> time_limit) {
    for (int i = 0; i < workers; ++i)
      workers_.push_back(std::make_unique<ProcessWorker>(command, time_limit));
  }

  int workers() const override { return static_cast<int>(workers_.size()); }

  void run(const std::vector<VariantTask>& tasks, const std::function<void(Variant)>& finished,
           const std::function<bool()>& interrupted) override {
    // Where there are fewer than processes, each has the cores of some that have nothing to do.
    const int threads = workers() / std::max(1, static_cast<int>(tasks.size()));
    auto next = tasks.begin();
    for (;;) {
      for (const auto& worker : workers_)
        if (!worker->busy() && next != tasks.end() && !interrupted()) {
          VariantTask task = *next++;
          task.threads = std::max(1, threads);
          worker->begin(std::move(task));
        }
      if (std::none_of(workers_.begin(), workers_.end(), [](const auto& worker) { return worker->busy(); }))
        return;
      if (interrupted()) return;  // what runs is ended with its process, or thrown away when it comes
      wait();
      for (const auto& worker : workers_)
        if (worker->busy())
          if (auto variant = worker->take()) finished(std::move(*variant));
    }
  }

 private:
  void wait() const {
    std::vector<pollfd> descriptors;
    for (const auto& worker : workers_)
      if (worker->busy()) descriptors.push_back({worker->descriptor(), POLLIN, 0});
    constexpr int milliseconds = 200;  // in which time limits and interrupts are seen
    poll(descriptors.data(), descriptors.size(), milliseconds);
  }

  std::vector<std::unique_ptr<ProcessWorker>> workers_;
};

}  // namespace

std::unique_ptr<StudyEngine> make_process_pool(const WorkerCommand& command, int workers,
                                               std::optional<double> time_limit) {
  return std::make_unique<ProcessPool>(command, workers, time_limit);
}

}  // namespace nurbeam
