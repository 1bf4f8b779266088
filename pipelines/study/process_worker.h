#pragma once
#include <chrono>
#include <optional>
#include <string>

#include "pipelines/study/engine.h"

namespace nurbeam {

/// A process that runs one variant at a time, started with its first one. Not copyable; the process ends with
/// it.
class ProcessWorker {
 public:
  explicit ProcessWorker(WorkerCommand command, std::optional<double> time_limit);
  ProcessWorker(const ProcessWorker&) = delete;
  ~ProcessWorker();

  bool busy() const { return task_.has_value(); }
  /// Precondition: not busy. A process that has ended is started anew; throws std::runtime_error where that
  /// fails.
  void begin(VariantTask task);
  /// The descriptor to wait for, while busy.
  int descriptor() const { return output_; }
  /// What has come of the task so far: the variant, where it has ended, however that was.
  std::optional<Variant> take();

 private:
  void start();
  void stop();
  Variant ended(VariantStatus status, std::string reason);

  WorkerCommand command_;
  std::optional<double> time_limit_;
  int process_ = -1, input_ = -1, output_ = -1;
  std::string received_;
  std::optional<VariantTask> task_;
  std::chrono::steady_clock::time_point begun_;
};

}  // namespace nurbeam
