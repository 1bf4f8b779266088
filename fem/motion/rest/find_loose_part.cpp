#include "fem/motion/rest/find_loose_part.h"

#include "fem/motion/record/loaded_between.h"
#include "solver/rest/mechanism.h"

namespace nurbeam {

namespace {

// The unit vector along a move, with the sign that makes its largest component positive.
Eigen::Vector3d direction_of(const Eigen::Vector3d& move) {
  Eigen::Index largest = 0;
  move.cwiseAbs().maxCoeff(&largest);
  return (move[largest] < 0 ? -1.0 : 1.0) * move.normalized();
}

// The part that moves furthest in a motion (n); nothing where sections only turn in their places.
std::optional<LoosePart> furthest_part(const BeamSystem& system, const Eigen::VectorXd& motion) {
  const Mesh& mesh = system.mesh();
  const BeamModel& model = system.model();
  LoosePart loose;
  Eigen::Vector3d furthest = Eigen::Vector3d::Zero();
  const auto is_further = [&](int r) {
    constexpr double further = 1 + 1e-6;  // not by round-off
    Eigen::Vector3d move = Eigen::Vector3d::Zero();
    move.head(mesh.dimension) = motion.segment(r, mesh.dimension);
    if (move.norm() <= further * furthest.norm()) return false;
    furthest = move;
    return true;
  };
  for (std::size_t body = 0; body < model.bodies.size(); ++body)
    if (is_further(mesh.bodies[body])) loose = LoosePart{model.bodies[body].name, true};
  for (std::size_t beam = 0; beam < mesh.nodes.size(); ++beam)
    for (const MeshNode& node : mesh.nodes[beam])
      if (is_further(node.r)) loose = LoosePart{model.beams[beam].name, false, node.s};
  constexpr double turns_alone = 1e-6;
  const double size = system.coordinate_scale().maxCoeff();
  if (!(furthest.norm() > turns_alone * size)) return std::nullopt;
  loose.direction = direction_of(furthest);
  return loose;
}

}  // namespace

std::optional<LoosePart> find_loose_part(const MeshedState& at, const std::function<bool()>& interrupted) {
  const Loading here{at.state.load, at.state.t};
  State state = at.state;
  state.load = 0;
  const LoadedBetween system(*at.system, here, here, interrupted);
  const std::optional<Eigen::VectorXd> motion = find_mechanism(system, state);
  return motion ? furthest_part(*at.system, *motion) : std::nullopt;
}

std::optional<LoosePart> find_free_part(const MeshedState& at) {
  const std::optional<Eigen::VectorXd> motion = softest_motion(*at.system, at.state);
  return motion ? furthest_part(*at.system, *motion) : std::nullopt;
}

}  // namespace nurbeam
