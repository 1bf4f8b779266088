#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/record/simulation_report.h"
#include "fem/motion/remesh/transfer.h"

namespace nurbeam {

/// A mesh of a model, and the model's state on it. A mesh does not change: another takes its place.
struct MeshedState {
  std::shared_ptr<const BeamSystem> system;
  State state;

  /// The model as it is drawn; `like`, which may be null, is that of a neighbouring model.
  static MeshedState drawn(std::shared_ptr<const BeamModel> model, const BeamSystem* like = nullptr);
};

/// A motion on another mesh.
struct ChangedMesh {
  MeshedState now;
  Eigen::VectorXd impulse = {};  ///< of the projection (see Transferred); empty where there was none
  EnergyKeeping keeping = {};    ///< see Transferred
  std::vector<int> around = {};  ///< unknowns that changed (changed_unknowns)
};

/// On the mesh that length control asks for; `at_rest`: riders are held there, and there are no velocities to
/// project. Empty where velocities cannot be projected.
std::optional<ChangedMesh> changed_mesh(const MeshedState& at, const NextPlan& next, bool at_rest);
/// Of a motion whose energy is known.
std::optional<ChangedMesh> changed_mesh(const MeshedState& at, const NextPlan& next,
                                        const SystemEnergy& energy);

/// Of a motion that has yet to begin as it is drawn: the shape stays, whatever the energy.
std::optional<ChangedMesh> changed_drawing(const MeshedState& at, const NextPlan& next);

/// Goes on there.
[[nodiscard]] std::optional<Failure> change_mesh(MeshedState& at, const NextPlan& next, bool at_rest);
/// The same as a neighbouring motion, whose energy has been kept so, and is one of this system
/// now.
[[nodiscard]] std::optional<Failure> change_mesh_like(MeshedState& at, const NextPlan& next,
                                                      const BeamSystem& neighbour,
                                                      const EnergyKeeping& keeping,
                                                      NeighbourSolvers& solvers);

/// Each change of the mesh makes the next less likely: a failure when there were more at one moment, `count`,
/// than that can be.
[[nodiscard]] std::optional<Failure> excess_of_changes(const MeshedState& at, std::size_t count);

}  // namespace nurbeam
