#include "nurbs/curve_chain.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "nurbs/curve_vertices.h"

namespace nurbeam {
namespace {

/// The cubic with its end moved to `point`; its end direction stays.
RationalCubic with_end_at(const RationalCubic& cubic, const Eigen::Vector3d& point) {
  const Eigen::Vector3d shift = point - cubic.control_point(3);
  Eigen::Matrix4d points = cubic.points();
  points.col(2).head<3>() += cubic.weight(2) * shift;
  points.col(3).head<3>() = cubic.weight(3) * point;
  return RationalCubic(points);
}

/// Moves the end of `before` and the start of `after` to the point midway; returns how far each moved [m].
/// A gap of the size of the coordinates' round-off is left.
double close_gap(RationalCubic& before, RationalCubic& after) {
  const Eigen::Vector3d end = before.control_point(3);
  const Eigen::Vector3d start = after.control_point(0);
  const double gap = (start - end).norm();
  if (gap <= 1e-15 * end.norm()) return 0;
  const Eigen::Vector3d middle = 0.5 * (start + end);
  before = with_end_at(before, middle);
  after = with_end_at(after.reversed(), middle).reversed();
  return 0.5 * gap;
}

/// For each end of each curve the one other end that meets it; nothing where none or more than one does.
class MeetingEnds {
 public:
  MeetingEnds(const std::vector<NurbsCurve>& curves, double tolerance) : partners_(curves.size()) {
    for (const CurveVertex& vertex : vertices_of(curves, tolerance)) {
      if (vertex.ends.size() != 2) continue;
      partner(vertex.ends[0]) = vertex.ends[1];
      partner(vertex.ends[1]) = vertex.ends[0];
    }
  }
  const std::optional<CurveEnd>& of(const CurveEnd& end) const { return partners_[end.curve][end.at_end]; }

 private:
  std::optional<CurveEnd>& partner(const CurveEnd& end) { return partners_[end.curve][end.at_end]; }

  std::vector<std::array<std::optional<CurveEnd>, 2>> partners_;
};

void reverse(Chain& chain) {
  std::reverse(chain.curves.begin(), chain.curves.end());
  std::reverse(chain.reversed.begin(), chain.reversed.end());
  chain.reversed.flip();
}

/// Lengthens the chain at its end as far as the curves go on; closed when that leads back to its first curve.
void follow(Chain& chain, const MeetingEnds& ends) {
  while (!chain.closed) {
    const std::optional<CurveEnd>& next = ends.of({chain.curves.back(), !chain.reversed.back()});
    if (!next) return;
    if (next->curve == chain.curves.front()) {
      chain.closed = true;
    } else {
      chain.curves.push_back(next->curve);
      chain.reversed.push_back(next->at_end);
    }
  }
}

}  // namespace

std::vector<Chain> find_chains(const std::vector<NurbsCurve>& curves, double tolerance) {
  const MeetingEnds ends(curves, tolerance);
  std::vector<bool> used(curves.size(), false);
  std::vector<Chain> chains;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (used[i]) continue;
    Chain chain{{static_cast<int>(i)}, {false}, false};
    follow(chain, ends);
    if (!chain.closed) {
      reverse(chain);
      follow(chain, ends);
      reverse(chain);
      if (chain.reversed.front() && chain.reversed.back()) reverse(chain);
    }
    for (const int curve : chain.curves) used[curve] = true;
    chains.push_back(std::move(chain));
  }
  return chains;
}

BezierPath join(const std::vector<NurbsCurve>& curves, const Chain& chain, double tolerance) {
  BezierPath joined;
  double largest_shift = 0;
  for (std::size_t i = 0; i < chain.curves.size(); ++i) {
    const NurbsCurve& curve = curves.at(chain.curves[i]);
    const BezierPath next = BezierPath::from_nurbs(chain.reversed[i] ? curve.reversed() : curve, tolerance);
    if (i == 0) joined.breaks = {next.breaks.front()};
    const std::size_t joint = joined.segments.size();
    const double offset = joined.breaks.back() - next.breaks.front();
    joined.segments.insert(joined.segments.end(), next.segments.begin(), next.segments.end());
    for (std::size_t j = 1; j < next.breaks.size(); ++j) joined.breaks.push_back(offset + next.breaks[j]);
    joined.deviation = std::max(joined.deviation, next.deviation);
    if (i > 0)
      largest_shift = std::max(largest_shift, close_gap(joined.segments[joint - 1], joined.segments[joint]));
  }
  if (chain.closed)
    largest_shift = std::max(largest_shift, close_gap(joined.segments.back(), joined.segments.front()));
  joined.deviation += largest_shift;
  return joined;
}

}  // namespace nurbeam
