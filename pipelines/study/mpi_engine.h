#pragma once
#include <memory>
#include <optional>

#include "pipelines/study/engine.h"

namespace nurbeam {

/// Whether this process is one of several that mpirun, or Slurm's srun with PMIx, has started.
bool started_by_mpi();

/// MPI, from construction to destruction. Precondition: started_by_mpi().
class MpiSession {
 public:
  MpiSession();
  MpiSession(const MpiSession&) = delete;
  ~MpiSession();

  int rank() const;
  int size() const;
  /// What rank 0 says, at every rank.
  bool agreed(bool of_rank_0) const;
};

/// At rank 0: each of the other ranks runs one variant after another. There must be two ranks at least.
std::unique_ptr<StudyEngine> make_mpi_engine(const MpiSession& session);

/// At the other ranks: runs what comes, in a process of its own (`command`), until the engine of rank 0 ends.
void serve_mpi(const MpiSession& session, const WorkerCommand& command, std::optional<double> time_limit);

}  // namespace nurbeam
