#include "fem/motion/remesh/matched_node.h"

#include <Eigen/QR>
#include <cmath>
#include <optional>
#include <vector>

#include "fem/element/quadrature.h"
#include "fem/system/material_points.h"

namespace nurbeam {

namespace {

// The conditions on a node between two spans: their residuals, and their gradient in (r, l r_s).
struct Conditions {
  Eigen::VectorXd excess;
  Eigen::Matrix<double, Eigen::Dynamic, 6> gradient;
};

// The Legendre coefficient e_k, k = 0..2, of a strain over the part [x_1, x_2] of its element.
double coefficient(const AssumedStrain& strain, int k, double x_1, double x_2) {
  double sum = 0;
  for (int g = 0; g < GaussRule::size; ++g) {
    const double x = x_1 + (x_2 - x_1) * GaussRule::points[g];
    sum += strain_weights(x, GaussRule::weights[g] * (x_2 - x_1), x_1, x_2 - x_1)[k] * strain.at(x);
  }
  return sum;
}

// The matched node between two spans. Both spans are to carry the strain that one had before: means and the
// value at the node, and what else the assumed strain takes of spans with own slopes.
class NodeMatch {
 public:
  /// `drawn`: any state of `to` with the same ends of spans.
  NodeMatch(const BeamSystem& to, const State& drawn, const MeshNode& node, int left, int right,
            const AssumedStrain& strain, double length, double xi)
      : to_(to), node_(node), length_(length) {
    const std::array<OwnSlopes, 2> own{own_slopes(to, left), own_slopes(to, right)};
    for (const int side : {0, 1})
      for (int k = 0; k <= own[static_cast<std::size_t>(side)].count(); ++k) {
        const double from = side == 0 ? 0 : xi, until = side == 0 ? xi : 1;
        spans_.push_back({SpanStrain(to, drawn, side == 0 ? left : right, k), side,
                          length * (until - from) * coefficient(strain, k, from, until)});
      }
    if (!own[0].at_b) at_node_ = length * strain.at(xi);
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
  // A strain of the span to the left (0) or right (1), and its wanted value.
  struct OfSpan {
    SpanStrain strain;
    int side;
    double wanted;
  };

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
      Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, Eigen::Dynamic, 6>> solver;
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
    const auto count = static_cast<Eigen::Index>(spans_.size());
    Conditions c;
    c.excess.resize(count + (at_node_ ? 1 : 0));
    c.gradient.resize(c.excess.size(), 6);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto& [strain, side, wanted] = spans_[static_cast<std::size_t>(i)];
      const StrainIntegral now = strain.at(state);
      const std::size_t end = side == 0 ? 1 : 0;
      c.excess[i] = now.value - wanted;
      c.gradient.row(i) << now.by_position[end].transpose(), now.by_slope[end].transpose() / length_;
    }
    if (!at_node_) return c;
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();
    slope.head(to_.dimension()) = state.q.segment(node_.slope_right, to_.dimension());
    c.excess[count] = length_ * (slope.squaredNorm() - 1) / 2 - *at_node_;
    c.gradient.row(count) << Eigen::RowVector3d::Zero(), slope.transpose();
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
  double length_;
  std::vector<OfSpan> spans_;
  std::optional<double> at_node_;  // the strain there times the length; none where the spans do not share it
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
