#include "fem/motion/remesh/relative_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>

#include "fem/motion/remesh/new_elements.h"
#include "fem/motion/remesh/tangent_blocks.h"

namespace nurbeam {

namespace {

// The surroundings of some nodes: the nodes, the elements between them and the bodies there.
class Surroundings {
 public:
  Surroundings(const BeamSystem& system, const State& state, const NodeSet& nodes)
      : system_(system), state_(state) {
    const Mesh& mesh = system.mesh();
    for (const auto& [beam, i] : nodes) take(mesh.nodes[beam][i]);
    for (const int i : spans_beside(mesh, nodes)) {
      const MeshSpan& span = mesh.spans[i];
      if (!nodes.contains({span.beam, span.node_a}) || !nodes.contains({span.beam, span.node_b})) continue;
      if (span.bubble >= 0) turns_.insert(span.bubble);
      take_points_on(span);
    }
  }

  // Coordinates of positions, slopes and places of riders.
  std::vector<int> moving() const {
    std::set<int> moving = places_;
    for (const auto& of : {positions_, slopes_})
      for (const int x : of)
        for (int k = 0; k < system_.dimension(); ++k) moving.insert(x + k);
    return {moving.begin(), moving.end()};
  }

  // All coordinates: the moving ones and the angles and bubbles of sections.
  std::vector<int> all() const {
    std::vector<int> all = moving();
    all.insert(all.end(), turns_.begin(), turns_.end());
    std::sort(all.begin(), all.end());
    return all;
  }

  bool is_place(int dof) const { return places_.contains(dof); }

  // (rigid motions, all) Translations and rotations as changes of the coordinates.
  Eigen::MatrixXd rigid_motions() const {
    const int D = system_.dimension();
    const std::vector<int> columns = all();
    Eigen::MatrixXd motions =
        Eigen::MatrixXd::Zero(D == 2 ? 3 : 6, static_cast<Eigen::Index>(columns.size()));
    const auto column = [&](int dof) {
      return std::lower_bound(columns.begin(), columns.end(), dof) - columns.begin();
    };
    const auto rotate = [&](int dof, const Eigen::VectorXd& x) {
      auto turned = motions.bottomRows(motions.rows() - D).middleCols(column(dof), D);
      if (D == 2)
        turned << -x[1], x[0];
      else
        turned << 0, -x[2], x[1], x[2], 0, -x[0], -x[1], x[0], 0;
    };
    const Eigen::VectorXd centre = state_.q.segment(*positions_.begin(), D);
    for (const int r : positions_) {
      motions.topRows(D).middleCols(column(r), D).setIdentity();
      rotate(r, state_.q.segment(r, D) - centre);
    }
    for (const int slope : slopes_) rotate(slope, state_.q.segment(slope, D));
    return motions;
  }

 private:
  void take(const MeshNode& node) {
    positions_.insert(node.r);
    slopes_.insert({node.slope_left, node.slope_right});
    if (node.angle_left >= 0) turns_.insert({node.angle_left, node.angle_right});
    if (node.rider >= 0) take_joint(node.rider);
  }

  void take_points_on(const MeshSpan& span) {
    const Mesh& mesh = system_.mesh();
    for (int j = 0; j < static_cast<int>(mesh.riders.size()); ++j) {
      if (mesh.plan.modes[j] != Carried::point || system_.model().riders[j].beam != span.beam) continue;
      const double s = state_.q[mesh.riders[j].place];
      if (span.start(state_.q) <= s && s <= span.end(state_.q)) take_joint(j);
    }
  }

  void take_joint(int rider) {
    const Mesh& mesh = system_.mesh();
    if (mesh.riders[rider].place >= 0) places_.insert(mesh.riders[rider].place);
    positions_.insert(mesh.bodies[system_.model().riders[rider].body]);
  }

  const BeamSystem& system_;
  const State& state_;
  std::set<int> positions_, slopes_, places_, turns_;
};

}  // namespace

RelativeMotion relative_motion(const BeamSystem& from, const BeamSystem& to, const State& state) {
  const NodeSet nodes = without_pointwise_strain(to.model(), nodes_of_new_elements(from, to));
  if (nodes.empty()) return {};
  const Surroundings near(to, state, nodes), wide(to, state, with_neighbours(to.mesh(), nodes));
  const std::vector<int> coordinates = near.moving(), around = wide.all();
  std::vector<int> own;  // indices of `coordinates` in `around`
  for (const int dof : coordinates)
    own.push_back(static_cast<int>(std::lower_bound(around.begin(), around.end(), dof) - around.begin()));

  State still = state;
  still.a.setZero();
  still.lambda = Eigen::VectorXd::Zero(to.constraint_count());
  const TangentBlocks tangent(to, still, {.mass = 1}, around);
  const Eigen::MatrixXd& M = tangent.coordinates();
  const Eigen::MatrixXd momenta = wide.rigid_motions() * M(Eigen::all, own);
  Eigen::MatrixXd kept(own.size(), tangent.gradient().rows() + momenta.rows());
  kept << tangent.gradient()(Eigen::all, own).transpose(), momenta.transpose();
  for (auto row : kept.colwise())
    if (const double size = row.norm(); size > 0) row /= size;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> across;
  across.setThreshold(1e-8);
  across.compute(kept);
  const Eigen::MatrixXd Q = across.householderQ(), along = Q.rightCols(Q.cols() - across.rank());

  // Places of riders have no mass of their own; they have it where they move along with a body.
  const Eigen::LLT<Eigen::MatrixXd> mass(along.transpose() * M(own, own) * along);
  if (mass.info() != Eigen::Success) return {};
  const Eigen::VectorXd momentum = along.transpose() * (M(own, Eigen::all) * state.v(around)),
                        motion = mass.solve(momentum);
  RelativeMotion relative{coordinates, along * motion, motion.dot(momentum) / 2};
  const double none = 1e-12 * relative.velocities.lpNorm<Eigen::Infinity>();
  for (Eigen::Index i = 0; i < relative.velocities.size(); ++i) {
    const double part = std::abs(relative.velocities[i]), rate = std::abs(state.v[coordinates[i]]);
    if (near.is_place(coordinates[i]) && part > none)
      relative.of_bodies = std::max(relative.of_bodies, part / rate);
  }
  return relative;
}

std::optional<double> RelativeMotion::growth(double e) const {
  constexpr double of_all = 10, less_of_all = 0.3, of_bodies_at_most = 5e-4;
  if (kinetic == 0 || !(e < kinetic)) return std::nullopt;
  const double part = std::sqrt(1 - e / kinetic) - 1;
  if (part < -less_of_all || part > of_all || !(std::abs(part) * of_bodies <= of_bodies_at_most))
    return std::nullopt;
  return part;
}

}  // namespace nurbeam
