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

  /// The drawn state of a model. `like`, which may be null: the system of a neighbouring model.
  static MeshedState drawn(std::shared_ptr<const BeamModel> model, const BeamSystem* like = nullptr);
};

/// A motion that was carried over to another mesh.
struct ChangedMesh {
  MeshedState now;
  Eigen::VectorXd impulse = {};  ///< of the projection (see Transferred); empty without a projection
  EnergyKeeping keeping = {};    ///< see Transferred
  std::vector<int> around = {};  ///< unknowns that changed (changed_unknowns)
};

/// The motion on the mesh that length control asks for. `at_rest`: riders are held there, and there are no
/// velocities to project. Empty where velocities cannot be projected.
std::optional<ChangedMesh> changed_mesh(const MeshedState& at, const NextPlan& next, bool at_rest);
/// The motion on the new mesh, where its energy is known already.
std::optional<ChangedMesh> changed_mesh(const MeshedState& at, const NextPlan& next,
                                        const SystemEnergy& energy);

/// A motion that has yet to begin from the drawing, on the new mesh: the shape stays, whatever the energy.
std::optional<ChangedMesh> changed_drawing(const MeshedState& at, const NextPlan& next);

/// Replaces the mesh and carries the state over.
[[nodiscard]] std::optional<Failure> change_mesh(MeshedState& at, const NextPlan& next, bool at_rest);
/// Replaces the mesh as a neighbouring motion has done. `neighbour`: its system now; `keeping`: how its
/// energy was conserved.
[[nodiscard]] std::optional<Failure> change_mesh_like(MeshedState& at, const NextPlan& next,
                                                      const BeamSystem& neighbour,
                                                      const EnergyKeeping& keeping,
                                                      NeighbourSolvers& solvers);

/// A failure when `count` changes of the mesh at one moment are more than possible, as each change makes the
/// next less likely.
[[nodiscard]] std::optional<Failure> excess_of_changes(const MeshedState& at, std::size_t count);

}  // namespace nurbeam
