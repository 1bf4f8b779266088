#include "pipelines/study/mpi_engine.h"

#include <mpi.h>
#include <poll.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "pipelines/study/process_worker.h"
#include "pipelines/study/rows.h"

namespace nurbeam {

namespace {

constexpr int tag = 0;

void send(const std::string& text, int rank) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, rank, tag, MPI_COMM_WORLD);
}

std::string receive(const MPI_Status& found) {
  int size = 0;
  MPI_Get_count(&found, MPI_CHAR, &size);
  std::string text(static_cast<std::size_t>(size), '\0');
  MPI_Recv(text.data(), size, MPI_CHAR, found.MPI_SOURCE, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return text;
}

/// Waiting ranks leave the core to those that run: MPI's own waiting takes it whole.
MPI_Status wait_for(int rank) {
  for (;;) {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(rank, tag, MPI_COMM_WORLD, &there, &status);
    if (there != 0) return status;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

class MpiEngine : public StudyEngine {
 public:
  explicit MpiEngine(int ranks) : ranks_(ranks) {}
  ~MpiEngine() override {
    for (int rank = 1; rank < ranks_; ++rank) send("", rank);  // the end
  }

  int workers() const override { return ranks_ - 1; }

  void run(const std::vector<VariantTask>& tasks, const std::function<void(Variant)>& finished,
           const std::function<bool()>& interrupted) override {
    std::vector<int> idle;
    for (int rank = ranks_ - 1; rank >= 1; --rank) idle.push_back(rank);
    auto next = tasks.begin();
    for (;;) {
      while (!idle.empty() && next != tasks.end() && !interrupted()) {
        send(line_of({.number = next->number, .values = next->values}), idle.back());
        idle.pop_back();
        ++next;
      }
      if (static_cast<int>(idle.size()) == workers()) return;
      const MPI_Status status = wait_for(MPI_ANY_SOURCE);
      idle.push_back(status.MPI_SOURCE);
      finished(variant_of(receive(status)));
    }
  }

 private:
  int ranks_;
};

}  // namespace

bool started_by_mpi() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (!size) size = std::getenv("PMI_SIZE");
  if (!size && std::getenv("PMIX_RANK")) size = std::getenv("SLURM_STEP_NUM_TASKS");  // srun --mpi=pmix
  return size && std::atoi(size) > 1;
}

MpiSession::MpiSession() {
  if (MPI_Init(nullptr, nullptr) != MPI_SUCCESS) throw std::runtime_error("MPI cannot be initialised");
}

MpiSession::~MpiSession() { MPI_Finalize(); }

int MpiSession::rank() const {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int MpiSession::size() const {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

bool MpiSession::agreed(bool of_rank_0) const {
  int value = of_rank_0 ? 1 : 0;
  MPI_Bcast(&value, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return value != 0;
}

std::unique_ptr<StudyEngine> make_mpi_engine(const MpiSession& session) {
  return std::make_unique<MpiEngine>(session.size());
}

void serve_mpi(const MpiSession&, const WorkerCommand& command, std::optional<double> time_limit) {
  ProcessWorker worker(command, time_limit);
  for (;;) {
    const std::string task = receive(wait_for(0));
    if (task.empty()) return;
    const Variant asked = variant_of(task);
    worker.begin({asked.number, asked.values});
    for (;;) {
      constexpr int milliseconds = 200;
      pollfd descriptor{worker.descriptor(), POLLIN, 0};
      poll(&descriptor, 1, milliseconds);
      if (const auto variant = worker.take()) {
        send(line_of(*variant), 0);
        break;
      }
    }
  }
}

}  // namespace nurbeam
