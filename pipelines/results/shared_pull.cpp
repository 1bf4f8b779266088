#include "pipelines/results/shared_pull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace nurbeam {

namespace {

// Whether it holds its beam along the axis.
bool holds_along(const Support& support, const ReferenceCurve& curve) {
  return !support.guide || std::abs(support.guide->normalized().dot(curve.tangent(support.s))) < 0.1;
}

// Whether the axial force can jump there.
bool is_kink(const HomeNode& node) { return node.kind != NodeKind::smooth; }

// The next support on or back along its beam that holds it along the axis, -1 where there is none.
int next_along(const BeamModel& model, const Support& support, bool on) {
  int next = -1;
  double distance = std::numeric_limits<double>::infinity();
  for (int c = 0; c < static_cast<int>(model.constraints.size()); ++c) {
    const auto* const other = std::get_if<Support>(&model.constraints[c]);
    if (!other || other->beam != support.beam || !holds_along(*other, model.beams[support.beam].curve))
      continue;
    const double away = on ? other->s - support.s : support.s - other->s;
    if (away <= 0 || away >= distance) continue;
    next = c;
    distance = away;
  }
  return next;
}

struct Stretch {
  double length = 0, chord = 0;             // [m]
  double force = 0;                         // of the largest magnitude [N]
  double beside_start = 0, beside_end = 0;  // lengths of its first and its last element [m]
};

// The elements from s to s_end.
Stretch stretch_of(const std::vector<ElementRecord>& elements, double s, double s_end) {
  Stretch stretch;
  Eigen::Vector3d begin = Eigen::Vector3d::Zero(), end = begin;
  const double same = 1e-9 * (1 + std::abs(s_end));
  for (const ElementRecord& e : elements) {
    if (e.s_start < s - same || e.s_end > s_end + same) continue;
    Eigen::Matrix<double, 3, 4> P = e.control_points.topRows<3>();
    for (int i = 0; i < 4; ++i) P.col(i) /= e.control_points(3, i);
    if (stretch.length == 0) {
      begin = P.col(0);
      stretch.beside_start = e.s_end - e.s_start;
    }
    end = P.col(3);
    stretch.beside_end = e.s_end - e.s_start;
    const double polygon = (P.rightCols<3>() - P.leftCols<3>()).colwise().norm().sum();
    stretch.length += (2 * (P.col(3) - P.col(0)).norm() + polygon) / 3;
    stretch.force = std::max(stretch.force, e.axial_force.cwiseAbs().maxCoeff());
  }
  stretch.chord = (end - begin).norm();
  return stretch;
}

// The direction of the axis at a node.
Eigen::Vector3d direction_at(const BeamRecord& beam, double s) {
  const auto nearest = std::min_element(beam.node_s.begin(), beam.node_s.end(), [&](double a, double b) {
    return std::abs(a - s) < std::abs(b - s);
  });
  return beam.node_slopes[nearest - beam.node_s.begin()].normalized();
}

}  // namespace

SharedPulls::SharedPulls(const BeamModel& model) : model_(model) {
  for (int c = 0; c < static_cast<int>(model.constraints.size()); ++c) {
    const auto* const support = std::get_if<Support>(&model.constraints[c]);
    if (!support) continue;
    const Beam& beam = model.beams[support->beam];
    const int home = beam.rigid ? -1 : beam.home_at(support->s);
    if (beam.is_ring() || home <= 0 || home >= beam.home_intervals() || is_kink(beam.home[home]) ||
        !holds_along(*support, beam.curve))
      continue;
    for (const bool on : {false, true}) {
      const int next = next_along(model, *support, on);
      if (next < 0) continue;
      const double s_next = std::get<Support>(model.constraints[next]).s;
      const double first = std::min(support->s, s_next), last = std::max(support->s, s_next);
      const bool has_kink = std::any_of(beam.home.begin(), beam.home.end(), [&](const HomeNode& node) {
        return node.s > first && node.s < last && is_kink(node);
      });
      if (!has_kink) parts_.push_back({support->beam, c, next, support->s, s_next, {beam.name, support->s}});
    }
  }
}

void SharedPulls::look_at(const Snapshot& frame) {
  for (Part& part : parts_) look_at(part, model_.beams[part.beam].properties.axial_stiffness, frame);
}

void SharedPulls::look_at(Part& part, double stiffness, const Snapshot& frame) {
  const BeamRecord& beam = frame.beams[part.beam];
  const auto [first, last] = std::minmax(part.s, part.s_next);
  const Stretch stretch = stretch_of(beam.elements, first, last);
  if (stretch.length == 0 || stretch.force == 0) return;  // its elements were written ahead
  constexpr double missed = 0.06;
  const double pull = std::abs(frame.reactions[part.constraint].force.dot(direction_at(beam, part.s)));
  const double beside = part.s < part.s_next ? stretch.beside_start : stretch.beside_end;
  const double slack = (stretch.length / stretch.chord - 1) * stiffness / stretch.force;
  const double error = missed * pull * beside / (last - first) / (1 + 2 * std::max(0.0, slack));
  const auto keep = [](double& largest, double value) { largest = std::max(largest, value); };
  keep(part.seen.pull, pull);
  keep(part.seen.error, error);
  keep(part.seen.force, stretch.force);
  keep(part.reaction, frame.reactions[part.next].force.norm());
}

std::vector<SharedPull> SharedPulls::coarse() const {
  std::vector<SharedPull> found;
  for (const Part& part : parts_) {
    if (part.seen.error <= 0.02 * std::max(part.seen.force, part.reaction)) continue;
    // Of the two sides of a support the worse one.
    if (!found.empty() && found.back().beam == part.seen.beam && found.back().s == part.seen.s) {
      if (part.seen.error / part.seen.force > found.back().error / found.back().force)
        found.back() = part.seen;
    } else {
      found.push_back(part.seen);
    }
  }
  return found;
}

}  // namespace nurbeam
