#pragma once
#include <memory>

#include "fem/motion/simulation_report.h"
#include "fem/motion/transfer.h"

namespace nurbeam {

/// A mesh of a model, and the model's state on it.
struct MeshedState {
  std::unique_ptr<BeamSystem> system;
  State state;

  /// The model as it is drawn.
  static MeshedState drawn(std::shared_ptr<const BeamModel> model);
};

/// Goes on on the mesh that length control asks for. `at_rest`: joints are held there, and there are no
/// velocities to project; else `impulse` is set to the projection's (see Transferred). False, and the report
/// says so, when velocities cannot be projected.
[[nodiscard]] bool change_mesh(MeshedState& at, const NextPlan& next, bool at_rest, Eigen::VectorXd& impulse,
                               SimulationReport& report);

/// Each change of the mesh makes the next less likely: false, and the report says so, when there were more
/// at one moment than that can be.
[[nodiscard]] bool check_changes(const MeshedState& at, std::size_t count, SimulationReport& report);

}  // namespace nurbeam
