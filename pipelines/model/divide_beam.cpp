#include "pipelines/model/divide_beam.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

// No element may be as short as the places between which it lies make it.
void check_intervals(const CaseBeam& beam, const std::vector<double>& places, Findings& findings) {
  const double L = places.back();
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i] - places[i - 1] < shortest_segment * L)
      findings.error("supports",
                     "a support of beam \"" + beam.name +
                         "\" and its neighbour (a support, an end or a "
                         "joint of two segments) are " +
                         text_of(places[i] - places[i - 1]) + " m apart, at s = " + text_of(places[i]) +
                         " m; move it there, or by at least " + text_of(shortest_segment * L) + " m");
}

void too_many(const CaseBeam& from, const std::string& key, const std::string& value, double count,
              const std::string& valid, Findings& findings) {
  findings.error(from.path + ".elements." + key, "is " + value + ": " + text_of(count) +
                                                     " elements, and the limit for one "
                                                     "beam is " +
                                                     std::to_string(most_elements) + "; give " + valid);
}

int fewest_in_ring(int sliding_bodies) { return 4 + 2 * sliding_bodies; }

// Elements of each interval; none, with a diagnostic, when they are too many.
std::vector<int> parts(const CaseBeam& from, const std::vector<double>& places, int sliding_bodies,
                       Findings& findings) {
  const int intervals = static_cast<int>(places.size()) - 1;
  const CaseElements& asked = from.elements;
  if (asked.per_segment) {
    const int most = most_elements / intervals;
    if (*asked.per_segment <= most) return std::vector<int>(intervals, *asked.per_segment);
    too_many(from, "per_segment", std::to_string(*asked.per_segment),
             static_cast<double>(intervals) * *asked.per_segment,
             most > 0 ? "at most " + std::to_string(most) : "an axis of fewer segments", findings);
    return {};
  }
  if (asked.max_length) {
    std::vector<double> counts;
    for (int i = 0; i < intervals; ++i)
      counts.push_back(
          std::max(1.0, std::ceil((places[i + 1] - places[i]) / *asked.max_length * (1 - 1e-12))));
    const double count = std::accumulate(counts.begin(), counts.end(), 0.0);
    if (count <= most_elements) return {counts.begin(), counts.end()};
    too_many(from, "max_length", text_of(*asked.max_length) + " m", count,
             intervals < most_elements
                 ? "at least " + text_of(places.back() / (most_elements - intervals)) + " m"
                 : "an axis of fewer segments",
             findings);
    return {};
  }
  const int first = asked.tolerance ? 4 + fewest_in_ring(sliding_bodies) : 20;  // adapt_mesh makes it finer
  return spread_elements(places, asked.count.value_or(std::max(first, intervals)));
}

// In space the angle of a corner that hardly turns, or turns right back, has no derivative.
void check_rigid_corner(const CaseBeam& from, const ReferenceCurve& curve, double s, const ModelFrame& frame,
                        Findings& findings) {
  if (frame.dimension == 2) return;
  const Eigen::Vector3d before = curve.tangent(s, true).normalized(), after = curve.tangent(s).normalized();
  const double sine = before.cross(after).norm(), cosine = before.dot(after);
  if (sine >= least_sine) return;
  const double least = std::asin(least_sine) * 180 / std::numbers::pi;
  findings.error(from.path + ".corners",
                 "is \"rigid\", but the corner at " + text_of(frame.to_world(curve.position(s))) +
                     " turns by " + text_of(std::atan2(sine, cosine) * 180 / std::numbers::pi) +
                     " degrees, and this is a spatial model, which keeps corners of " + text_of(least) +
                     " to " + text_of(180 - least) + " degrees: " +
                     (cosine > 0 ? "smooth it with \"smooth_up_to\": 2" : "round it") + ", or use \"hinge\"");
}

void check_ring_elements(const CaseBeam& from, int elements, int sliders, Findings& findings) {
  const int fewest = fewest_in_ring(sliders);
  if (elements < fewest)
    findings.error(from.path + ".elements", "gives " + std::to_string(elements) + " elements; a ring with " +
                                                std::to_string(sliders) + " sliding bodies needs at least " +
                                                std::to_string(fewest));
}

}  // namespace

std::vector<HomeNode> divide_beam(const CaseBeam& from, const DrawnBeam& drawn,
                                  const std::vector<double>& held_places, int sliding_bodies,
                                  const ModelFrame& frame, Findings& findings) {
  const std::vector<double> places = fixed_places(drawn.measured, held_places);
  check_intervals(from, places, findings);
  if (findings.has_errors()) return {};
  std::vector<int> counts;
  try {
    counts = parts(from, places, sliding_bodies, findings);
  } catch (const std::invalid_argument& problem) {
    findings.error(from.path + ".elements.count", problem.what());
    return {};
  }
  if (counts.empty()) return {};
  std::vector<HomeNode> home;
  try {
    home = home_nodes(places, counts, from.elements.grading);
  } catch (const std::invalid_argument& problem) {
    findings.error(from.path + ".elements.grading", problem.what());
    return {};
  }
  if (from.elements.grading != 0 && *from.elements.per_segment == 1)
    findings.warn(
        from.path + ".elements.grading",
        text_of(from.elements.grading) + " m has no effect with one element per segment; take 2 or more");
  for (HomeNode& node : home) node.s = drawn.material_coordinate(node.s);
  if (from.ring) {
    home.front().permanent = home.back().permanent = true;  // the seam is a break of the drawing
    check_ring_elements(from, static_cast<int>(home.size()) - 1, sliding_bodies, findings);
  }
  const bool is_rigid = from.corners == Corners::rigid;
  for (int corner : drawn.corners) {
    const double s = drawn.curve.breaks()[corner];
    if (is_rigid) check_rigid_corner(from, drawn.curve, s, frame, findings);
    for (HomeNode& node : home)
      if (node.s == s) node.kind = is_rigid ? NodeKind::rigid : NodeKind::hinge;
  }
  return home;
}

}  // namespace nurbeam
