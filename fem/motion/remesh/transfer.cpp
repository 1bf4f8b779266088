#include "fem/motion/remesh/transfer.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>

#include "fem/motion/remesh/balanced_nodes.h"
#include "fem/motion/remesh/least_move.h"
#include "fem/motion/remesh/new_elements.h"
#include "fem/motion/remesh/relative_motion.h"
#include "fem/motion/remesh/tangent_blocks.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/momentum.h"
#include "fem/system/observables.h"
#include "fem/system/same_elements.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

// A motion on a new mesh whose elements cannot hold it exactly.
class Remap {
 public:
  // `solvers`, which may be null: from a motion beside which this one lies.
  Remap(const BeamSystem& from, const State& state, const BeamSystem& to, NeighbourSolvers* solvers = nullptr)
      : from_(from),
        state_(state),
        to_(to),
        solvers_(solvers),
        momentum_(from, state, to),
        around_(changed_unknowns(from, to)),
        enough_(closed_enough(from, state)) {}

  // The state with velocities for the positions next.q, by L2 projection; nothing when that is singular.
  std::optional<Transferred> with_velocities(State next) {
    put_bodies(next);
    if (!close_constraints(to_, enough_, next)) return std::nullopt;
    const Projection projection = velocities(momentum_.on(next), next);
    if (projection.status != ConsistencyStatus::done) return std::nullopt;
    return Transferred{std::move(next), projection.impulse};
  }

  // Lets velocities take the excess of energy away; returns whether they can.
  bool keep_energy_by_velocities(Transferred& next) const {
    const RelativeMotion motion = relative_motion(from_, to_, next.state);
    const std::optional<double> growth = motion.growth(excess(next.state));
    if (!growth) return false;
    next.state.v(motion.coordinates) += *growth * motion.velocities;
    next.keeping.by_velocities = true;
    return true;
  }

  // Moves nodes so that the total energy is the old one. New elements as interpolated carry axial strain that
  // the old ones did not have, so their nodes move; where that is not enough, neighbours move too, ring by
  // ring.
  void keep_energy_by_moves(const SystemEnergy& old, Transferred& next) {
    constexpr double accuracy = 1e-10;
    const double enough =
        accuracy * (old.kinetic + old.axial + old.bending);  // does not depend on where the model lies
    double e = excess(next.state);
    constexpr int most_rings = 4;
    for (int rings = 0; rings <= most_rings && std::abs(e) > enough; ++rings) {
      const std::vector<int> free = free_coordinates(rings);
      constexpr int most_moves = 10;
      for (int i = 0; i < most_moves && std::abs(e) > enough && !free.empty(); ++i) {
        const double before = std::abs(e);
        if (!move_towards(next, rings, free, e) || std::abs(e) > 0.99 * before) break;
      }
    }
  }

  // Repeats the moves of a neighbour; returns whether they could be made.
  bool repeat(const std::vector<EnergyMove>& moves, Transferred& next) {
    for (const EnergyMove& move : moves) {
      const std::vector<int> free = free_coordinates(move.rings);
      const Eigen::VectorXd whole = move_of(next.state, free, excess(next.state), move.mu).d;
      std::optional<Transferred> moved = with_move(next.state, free, std::ldexp(1.0, -move.halvings) * whole);
      if (!moved) return false;
      next = std::move(*moved);
    }
    next.keeping.moves = moves;
    return true;
  }

  // The stages of the transfer with all moves; nothing where more was needed.
  std::optional<TransferPath> path(const EnergyKeeping& keeping) {
    if (!bodies_are_on_axes()) return std::nullopt;
    const std::vector<EnergyMove>& moves = keeping.moves;
    TransferPath path;
    State start = keeping.by_velocities ? balanced(from_, state_, to_) : interpolated(from_, state_, to_);
    std::optional<Transferred> next;
    for (std::size_t i = 0;; ++i) {
      put_bodies(start);
      if (!to_.admissible(start) || !(open_constraints(to_, start) <= enough_)) return std::nullopt;
      next = with_velocities(start);
      if (!next) return std::nullopt;
      path.stages.push_back(*next);
      if (keeping.by_velocities) path.excess = excess(next->state);
      if (i == moves.size()) return path;
      const EnergyMove& move = moves[i];
      const double e = excess(next->state);
      const std::vector<int> free = free_coordinates(move.rings);
      Eigen::MatrixXd allowed;
      const EnergyParabola energy = parabola(next->state, free, allowed);
      if (allowed.cols() == 0) return std::nullopt;
      LeastMove least = least_move(energy, e, move.mu);
      const double left = energy.g.dot(least.d) + least.d.dot(energy.K * least.d) / 2 + e;
      if (!(std::abs(left) <= 1e-6 * std::abs(e))) {
        if (!(std::abs(least.mu) * energy.M.norm() <= 1e-9 * energy.K.norm())) return std::nullopt;
        least.mu = 0;
      }
      path.moves.push_back({free, allowed * least.d, least.mu, move.halvings});
      start = next->state;
      start.q(free) += std::ldexp(1.0, -move.halvings) * path.moves.back().d;
    }
  }

 private:
  // Puts each body that is a point on the curve again, which the removal of its node has moved a little.
  void put_bodies(State& next) const {
    const BeamModel& model = to_.model();
    const Mesh& mesh = to_.mesh();
    for (std::size_t j = 0; j < mesh.riders.size(); ++j) {
      if (mesh.plan.modes[j] != Carried::point) continue;
      const double s = next.q[mesh.riders[j].place];
      next.q.segment(mesh.bodies[model.riders[j].body], mesh.dimension) =
          material_point(to_, next, model.riders[j].beam, s).r.head(mesh.dimension);
    }
    carry_bodies(to_, next);
  }

  bool bodies_are_on_axes() const {
    const std::vector<Rider>& riders = to_.model().riders;
    return std::none_of(riders.begin(), riders.end(), [](const Rider& j) { return j.is_offset(); });
  }

  // Projects velocities with this momentum at the positions next.q. A solution is near the one for the
  // positions before, and for neighbouring motions near theirs at the same positions.
  Projection velocities(const Eigen::VectorXd& momentum, State& next) {
    constexpr int few = 400;
    if (solvers_) {
      if (solved_ == solvers_->size()) solvers_->emplace_back();
      return velocities_beside(to_, momentum, around_, (*solvers_)[solved_++], next);
    }
    if (around_.empty() && to_.coordinate_count() > few) return velocities_from_momentum(to_, momentum, next);
    return velocities_from_momentum(to_, momentum, around_, own_, next);
  }

  double excess(const State& x) const { return energy_change(from_, state_, to_, x); }

  // The motion with the free coordinates moved; nothing where that is not possible.
  std::optional<Transferred> with_move(const State& from, const std::vector<int>& free,
                                       const Eigen::VectorXd& move) {
    State moved = from;
    for (std::size_t i = 0; i < free.size(); ++i) moved.q[free[i]] += move[static_cast<long>(i)];
    if (!to_.admissible(moved)) return std::nullopt;
    return with_velocities(std::move(moved));
  }

  // Makes one move of the free coordinates, halved until |e| falls. On the parabola of the potential energy
  // it takes the excess e away, or leads to the lowest place. Returns whether there is one; else nothing
  // changes.
  bool move_towards(Transferred& next, int rings, const std::vector<int>& free, double& e) {
    auto [move, mu] = move_of(next.state, free, e, std::nullopt);
    for (int halvings = 0; halvings < 4; ++halvings, move /= 2) {
      std::optional<Transferred> trial = with_move(next.state, free, move);
      if (!trial) continue;
      const double left = excess(trial->state);
      if (!(std::abs(left) < std::abs(e))) continue;
      next.state = std::move(trial->state);
      next.impulse = std::move(trial->impulse);
      next.keeping.moves.push_back({rings, halvings, mu});
      e = left;
      return true;
    }
    return false;
  }

  // The parabola of the potential energy where free coordinates move as constraints allow, one column of
  // `allowed` each.
  EnergyParabola parabola(const State& next, const std::vector<int>& free, Eigen::MatrixXd& allowed) const {
    State still = next;
    still.v.setZero();
    still.a.setZero();
    still.lambda = Eigen::VectorXd::Zero(to_.constraint_count());
    const TangentBlocks stiffness(to_, still, {.stiffness = 1}, free), mass(to_, still, {.mass = 1}, free);
    allowed = allowed_moves(mass.gradient());
    const bool all = mass.gradient().isZero(0);
    const auto part = [&](const TangentBlocks& tangent) {
      const Eigen::MatrixXd& whole = tangent.coordinates();
      const Eigen::MatrixXd block = all ? whole : allowed.transpose() * whole * allowed;
      return Eigen::MatrixXd((block + block.transpose()) / 2);
    };
    return {part(stiffness), part(mass), allowed.transpose() * residual_of(to_, still, free)};
  }

  // The least move of the free coordinates, in the mass norm, that takes the excess e of the energy away.
  // `near`: the mu of a neighbouring motion.
  LeastMove move_of(const State& next, const std::vector<int>& free, double e,
                    std::optional<double> near) const {
    Eigen::MatrixXd allowed;
    const EnergyParabola energy = parabola(next, free, allowed);
    if (allowed.cols() == 0) return {Eigen::VectorXd::Zero(allowed.rows()), 0};
    LeastMove move = near ? least_move(energy, e, *near) : least_move(energy, e);
    move.d = allowed * move.d;
    return move;
  }

  // (free, moves) An orthonormal basis of the moves that open no constraint with this gradient.
  static Eigen::MatrixXd allowed_moves(const Eigen::MatrixXd& G) {
    if (G.isZero(0)) return Eigen::MatrixXd::Identity(G.cols(), G.cols());
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> across(G.transpose());
    const Eigen::MatrixXd Q = across.householderQ();
    return Q.rightCols(G.cols() - across.rank());
  }

  // Coordinates that may move: positions, slopes and sections of the nodes of new elements and of `rings` of
  // neighbours, and the bubbles of new elements. Excluded are supported positions, clamped slopes, sections
  // at supports and positions of bodies that are nodes. Bodies carried as points go with the curve.
  std::vector<int> free_coordinates(int rings) const {
    const Mesh& mesh = to_.mesh();
    NodeSet nodes = nodes_of_new_elements(from_, to_);
    for (int ring = 0; ring < rings; ++ring) nodes = with_neighbours(mesh, nodes);
    std::set<int> free;
    for (const auto& [beam, i] : nodes) {
      const MeshNode& node = mesh.nodes[beam][i];
      const Hold hold = node.home >= 0 ? to_.model().beams[beam].home[node.home].hold : Hold::nothing;
      for (int k = 0; k < mesh.dimension; ++k) {
        if (node.rider < 0 && hold == Hold::nothing) free.insert(node.r + k);
        if (hold != Hold::clamp) free.insert({node.slope_left + k, node.slope_right + k});
      }
      if (node.angle_left >= 0 && hold == Hold::nothing) free.insert({node.angle_left, node.angle_right});
    }
    for (const MeshSpan& span : mesh.spans)
      if (span.bubble >= 0 && is_new(from_, to_, span)) free.insert(span.bubble);
    if (free.empty()) return {};
    for (std::size_t j = 0; j < mesh.riders.size(); ++j) {
      const Rider& rider = to_.model().riders[j];
      if (mesh.plan.modes[j] != Carried::point && !rider.is_offset()) continue;
      if (mesh.plan.modes[j] == Carried::free) continue;
      for (int k = 0; k < mesh.dimension; ++k) free.insert(mesh.bodies[rider.body] + k);
    }
    return {free.begin(), free.end()};
  }

  const BeamSystem& from_;
  const State& state_;
  const BeamSystem& to_;
  NeighbourSolvers* const solvers_;
  std::size_t solved_ = 0;  // number of `solvers_` used
  ProjectionSolver own_;    // used without `solvers_`
  const CarriedMomentum momentum_;
  const std::vector<int> around_;  // rows of the new mesh that may be open
  const double enough_;            // tolerance of closed constraints
};

}  // namespace

double closed_enough(const BeamSystem& from, const State& state) {
  return std::max(open_constraints(from, state), 1e-12 * state.q.lpNorm<Eigen::Infinity>());
}

State balanced(const BeamSystem& from, const State& state, const BeamSystem& to) {
  State next = interpolated(from, state, to);
  balance_added_nodes(from, to, next);
  carry_bodies(to, next);
  return next;
}

std::optional<Transferred> projected(const BeamSystem& from, const State& state, const SystemEnergy& energy,
                                     const BeamSystem& to) {
  Remap remap(from, state, to);
  std::optional<Transferred> next = remap.with_velocities(balanced(from, state, to));
  if (next && remap.keep_energy_by_velocities(*next)) return next;
  const bool is_balanced = !without_pointwise_strain(to.model(), new_nodes(from, to)).empty();
  if (is_balanced) next = remap.with_velocities(interpolated(from, state, to));
  if (next) remap.keep_energy_by_moves(energy, *next);
  return next;
}

std::optional<Transferred> projected(const BeamSystem& from, const State& state, const BeamSystem& to) {
  return projected(from, state, energy(from, state), to);
}

std::optional<Transferred> projected_like(const BeamSystem& from, const State& state, const BeamSystem& to,
                                          const EnergyKeeping& keeping, NeighbourSolvers& solvers) {
  Remap remap(from, state, to, &solvers);
  std::optional<Transferred> next = remap.with_velocities(
      keeping.by_velocities ? balanced(from, state, to) : interpolated(from, state, to));
  if (!next) return next;
  const bool is_kept =
      keeping.by_velocities ? remap.keep_energy_by_velocities(*next) : remap.repeat(keeping.moves, *next);
  if (!is_kept) return std::nullopt;
  return next;
}

std::optional<TransferPath> path_of(const BeamSystem& from, const State& state, const BeamSystem& to,
                                    const EnergyKeeping& keeping) {
  return Remap(from, state, to).path(keeping);
}

}  // namespace nurbeam
