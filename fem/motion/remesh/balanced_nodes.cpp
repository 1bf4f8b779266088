#include "fem/motion/remesh/balanced_nodes.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "fem/motion/remesh/new_elements.h"
#include "fem/motion/remesh/tangent_blocks.h"

namespace nurbeam {

namespace {

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& K) { return (K + K.transpose()) / 2; }

// The free coordinates of new nodes and of their neighbours.
class NodePatch {
 public:
  NodePatch(const BeamSystem& system, const State& state, const NodeSet& added) : system_(system) {
    const Mesh& mesh = system.mesh();
    for (const int i : spans_beside(mesh, added))
      length_ = std::min(length_, mesh.spans[i].end(state.q) - mesh.spans[i].start(state.q));
    for (const auto& [beam, i] : with_neighbours(mesh, added))
      take(beam, mesh.nodes[beam][i], added.contains({beam, i}));
    free_.insert(free_.end(), slopes_.begin(), slopes_.end());
    std::sort(free_.begin(), free_.end());
    leave_out_constrained(state);
  }

  // Newton's method with a stiffness at rest that is reused while it contracts. Nothing moves where Newton's
  // method does not lead to a place near by.
  void balance(State& next) const {
    constexpr int most_moves = 20;
    constexpr double far = 0.1, enough = 1e-12, slow = 0.1;
    State moved = next;
    moved.lambda = Eigen::VectorXd::Zero(system_.constraint_count());
    Eigen::LLT<Eigen::MatrixXd> stiffness = first_;
    double last = 0;
    for (int i = 0; i < most_moves && !free_.empty(); ++i) {
      if (i > 0 && last == 0) stiffness.compute(symmetric(stiffness_at(moved).coordinates()));
      if (stiffness.info() != Eigen::Success) return;
      const Eigen::VectorXd move = -stiffness.solve(residual_of(system_, moved, free_));
      const double now = size(move);
      if (!(now <= far * length_)) return;
      moved.q(free_) += move;
      if (!system_.admissible(moved)) return;
      const double contraction = last > 0 ? now / last : 1;
      if (contraction * now <= enough * length_) {
        next.q = moved.q;
        return;
      }
      last = last > 0 && contraction > slow ? 0 : now;
    }
  }

 private:
  // Takes the coordinates of a node that may move. A body that was a node stays where it is.
  void take(int beam, const MeshNode& node, bool is_added) {
    const Hold hold = node.home >= 0 ? system_.model().beams[beam].home[node.home].hold : Hold::nothing;
    for (int k = 0; k < system_.dimension(); ++k) {
      if (hold == Hold::nothing && (node.rider < 0 || is_added)) free_.push_back(node.r + k);
      if (hold == Hold::clamp) continue;
      slopes_.insert({node.slope_left + k, node.slope_right + k});
    }
  }

  void leave_out_constrained(const State& state) {
    const TangentBlocks stiffness = stiffness_at(state);
    std::vector<int> loose, places;
    for (int k = 0; k < static_cast<int>(free_.size()); ++k) {
      if (!stiffness.gradient().col(k).isZero(0)) continue;
      loose.push_back(free_[k]);
      places.push_back(k);
    }
    free_ = std::move(loose);
    first_.compute(symmetric(stiffness.coordinates()(places, places)));
  }

  TangentBlocks stiffness_at(const State& state) const {
    State still = state;
    still.v.setZero();
    still.a.setZero();
    still.lambda = Eigen::VectorXd::Zero(system_.constraint_count());
    return {system_, still, {.stiffness = 1}, free_};
  }

  // The size of a move, with slopes multiplied by the length of the element [m].
  double size(const Eigen::VectorXd& move) const {
    double largest = 0;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const double part = std::abs(move[static_cast<Eigen::Index>(k)]);
      largest = std::max(largest, slopes_.contains(free_[k]) ? length_ * part : part);
    }
    return largest;
  }

  const BeamSystem& system_;
  std::vector<int> free_;
  std::set<int> slopes_;
  Eigen::LLT<Eigen::MatrixXd> first_;
  double length_ = std::numeric_limits<double>::infinity();  // of the shortest element beside a new node [m]
};

}  // namespace

void balance_added_nodes(const BeamSystem& from, const BeamSystem& to, State& next) {
  const NodeSet added = without_pointwise_strain(to.model(), new_nodes(from, to));
  const bool starts = next.a.isZero(0) && !next.v.isZero(0);  // accelerations are not known yet
  if (added.empty() || starts) return;
  NodePatch(to, next, added).balance(next);
}

}  // namespace nurbeam
