#include "fem/motion/remesh/matched_node.h"

#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "fem/system/material_points.h"

namespace nurbeam {

namespace {

// The conditions on a node between two spans: their residuals, and their gradient in (r, l r_s).
struct Conditions {
  Eigen::Vector3d excess;
  Eigen::Matrix<double, 3, 6> gradient;
};

class NodeMatch {
 public:
  /// `drawn`: any state of `to` with the same ends of spans.
  NodeMatch(const BeamSystem& to, const State& drawn, const MeshNode& node, int left, int right,
            const AssumedStrain& strain, double length, double xi)
      : to_(to), node_(node), left_(to, drawn, left), right_(to, drawn, right), length_(length) {
    wanted_ << length * strain.mean_part(0, xi), length * strain.mean_part(xi, 1), length * strain.at(xi);
  }

  // Newton's method with least moves. Returns whether all conditions are met; else nothing has moved.
  bool move(State& next) const {
    const std::vector<int> moved = coordinates();
    const Eigen::VectorXd start = next.q(moved);
    if (meet(moved, next)) return true;
    next.q(moved) = start;
    return false;
  }

 private:
  std::vector<int> coordinates() const {
    std::vector<int> all;
    for (const int first : {node_.r, node_.slope_left, node_.slope_right})
      for (int d = 0; d < to_.dimension(); ++d) all.push_back(first + d);
    return all;
  }

  bool meet(const std::vector<int>& moved, State& next) const {
    constexpr int most_moves = 12;
    const double enough = 4e-16 * length_;
    Conditions now = conditions(next);
    for (int i = 0; i < most_moves; ++i) {
      const double before = now.excess.norm();
      if (before <= enough) return true;
      Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, 3, 6>> solver;
      solver.setThreshold(1e-9);
      solver.compute(now.gradient);
      const Eigen::Matrix<double, 6, 1> step = solver.solve(-now.excess);
      const Eigen::VectorXd start = next.q(moved);
      add(step, next);
      const Conditions then = conditions(next);
      if (!(then.excess.norm() < before)) {
        next.q(moved) = start;
        return before <= 1e-13 * length_;
      }
      now = then;
    }
    return now.excess.norm() <= 1e-13 * length_;
  }

  Conditions conditions(const State& state) const {
    const StrainIntegral a = left_.at(state), b = right_.at(state);
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();
    slope.head(to_.dimension()) = state.q.segment(node_.slope_right, to_.dimension());
    Conditions c;
    c.excess << a.value, b.value, length_ * (slope.squaredNorm() - 1) / 2;
    c.excess -= wanted_;
    c.gradient << a.by_position[1].transpose(), a.by_slope[1].transpose() / length_,
        b.by_position[0].transpose(), b.by_slope[0].transpose() / length_, Eigen::RowVector3d::Zero(),
        slope.transpose();
    return c;
  }

  void add(const Eigen::Matrix<double, 6, 1>& step, State& state) const {
    const int D = to_.dimension();
    state.q.segment(node_.r, D) += step.head(D);
    state.q.segment(node_.slope_left, D) += step.segment(3, D) / length_;
    if (node_.slope_right != node_.slope_left)
      state.q.segment(node_.slope_right, D) += step.segment(3, D) / length_;
  }

  const BeamSystem& to_;
  const MeshNode& node_;
  SpanStrain left_, right_;
  double length_;
  Eigen::Vector3d wanted_;
};

}  // namespace

void match_axial_strain(const BeamSystem& from, const State& state, const BeamSystem& to, int beam, int node,
                        State& next) {
  const Mesh &old = from.mesh(), &mesh = to.mesh();
  const MeshNode& added = mesh.nodes[beam][node];
  const double place = added.place >= 0 ? next.q[added.place] : added.s;
  const int span = find_span(from.model(), old, state.q, beam, place);
  const std::optional<AssumedStrain> strain = assumed_strain(from, state, span);
  if (!strain) return;
  const ReferenceCurve& curve = to.model().beams[beam].curve;
  const double start = old.spans[span].start(state.q), end = old.spans[span].end(state.q);
  const double s = curve.unrolled(place, (start + end) / 2);
  int left = -1, right = -1;
  for (int i = mesh.first_span[beam]; i < mesh.first_span[beam + 1]; ++i) {
    if (mesh.spans[i].node_b == node) left = i;
    if (mesh.spans[i].node_a == node) right = i;
  }
  if (left < 0 || right < 0) return;
  const double length = end - start;
  (void)NodeMatch(to, next, added, left, right, *strain, length, (s - start) / length).move(next);
}

}  // namespace nurbeam
