#include "pipelines/model/beam_axis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>

#include "nurbs/number_text.h"
#include "nurbs/primitives.h"
#include "nurbs/regular_segments.h"
#include "nurbs/smooth/smooth_corners.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/axis_selection.h"

namespace nurbeam {

namespace {

// A deviation that is none, a part of the length.
constexpr double round_off = 1e-12;

// A closed axis has its end on its start, to this part of its length.
constexpr double closed_gap = 1e-6;

std::vector<RationalCubic> cubics_of(const CaseBeam& beam, const BezierPath& path, bool above_cubic,
                                     Findings& findings) {
  if (above_cubic && path.deviation > round_off * total_length(path.segments))
    findings.warn(beam.path + ".axis", "a curve of degree above 3 was approximated; largest deviation " +
                                           text_of(path.deviation) + " m");
  return path.segments;
}

BeamAxis axis_from_file(const CaseBeam& beam, const AxisFile& axis, const Chain& chain, CadFiles& files,
                        Findings& findings) {
  const ImportReport& report = files.read(axis.path, findings);
  std::vector<NurbsCurve> curves;
  for (const ImportedCurve& curve : report.curves) curves.push_back(curve.curve);
  const std::string& name = report.curves[chain.curves[0]].name;
  const BezierPath path = join(curves, chain, approximation_tolerance(beam, curves, chain));
  const bool above_cubic =
      std::any_of(chain.curves.begin(), chain.curves.end(), [&](int i) { return curves[i].degree() > 3; });
  const int first = chain.curves.front();
  return {.curve_name = name.empty() ? beam.name : name,
          .segments = cubics_of(beam, path, above_cubic, findings),
          .source = AxisSource{axis.path, chain.curves, curves[first], chain.reversed.front()}};
}

// The axis has an extent, and coordinates that arithmetic can bear.
void check_extent(const CaseBeam& beam, const std::vector<RationalCubic>& segments, Findings& findings) {
  double largest = 0, extent = 0;
  for (const RationalCubic& cubic : segments)
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d p = cubic.control_point(i);
      largest = std::max(largest,
                         p.allFinite() ? p.cwiseAbs().maxCoeff() : std::numeric_limits<double>::infinity());
      extent = std::max(extent, (p - segments.front().control_point(0)).norm());
    }
  if (!(largest <= longest_beam))
    findings.error(beam.path + ".axis", "has a coordinate of " + text_of(largest) + " m; the limit is " +
                                            text_of(longest_beam) + " m (is the unit right?)");
  else if (!segments.empty() && extent < shortest_beam)
    findings.error(beam.path + ".axis", "has an extent of " + text_of(extent) + " m; the smallest is " +
                                            text_of(shortest_beam) + " m (is the unit right?)");
}

// What is there for comparison with the papers, whose beams have ends.
void check_ring(const CaseBeam& from, Findings& findings) {
  if (from.weights == WeightRule::constant)
    findings.error(from.path + ".weights",
                   "\"constant\" is a comparison for beams with ends; a ring needs \"material\"");
  if (from.metric == Metric::label)
    findings.error(from.path + ".metric",
                   "\"none\" is a comparison for beams with ends; a ring needs \"reference\"");
  for (const auto& [kind, name] : {std::pair(Corners::hinge, "hinge"), std::pair(Corners::rigid, "rigid")})
    if (from.corners == kind)
      findings.error(from.path + ".corners", in_quotes(name) + " is not available on a ring; leave it out");
}

// No less than the length, and found at once.
double polygons_length(const std::vector<RationalCubic>& segments) {
  return std::transform_reduce(segments.begin(), segments.end(), 0.0, std::plus<>(), polygon_length);
}

double gap_of(const std::vector<RationalCubic>& segments) {
  return (segments.front().control_point(0) - segments.back().control_point(3)).norm();
}

// The segments with one tangent at each joint where the digits of the drawing, not its author, made a kink:
// of a kink that stays an element would hold the angle in its drawn direction while the beam turns.
std::vector<RationalCubic> without_kinks(const CaseBeam& beam, std::span<const RationalCubic> segments,
                                         Findings& findings) {
  constexpr double arithmetic = 1e-12, digits = default_corner_angle;  // [rad]
  const std::vector<Corner> kinks = corners_of(segments, arithmetic);
  if (std::none_of(kinks.begin(), kinks.end(), [](const Corner& kink) { return kink.angle <= digits; }))
    return {segments.begin(), segments.end()};
  SmoothCorners smooth = smooth_corners(segments, digits);
  if (smooth.deviation > round_off * total_length(segments))
    findings.add(Severity::note, beam.path + ".axis",
                 "tangents that differed by up to " + text_of(digits) +
                     " rad were made one; largest deviation " + text_of(smooth.deviation) + " m");
  return smooth.segments;
}

// The axis of a ring: its end on its start, without a corner there, and two segments at least.
void close_ring(const CaseBeam& beam, std::vector<RationalCubic>& segments, Findings& findings) {
  const std::string where = beam.path + ".closed";
  const Eigen::Vector3d start = segments.front().control_point(0), end = segments.back().control_point(3);
  const double L = total_length(segments);
  if (gap_of(segments) > closed_gap * L)
    return findings.error(where, "is true, but the axis starts at " + text_of(start) + " and ends at " +
                                     text_of(end) + ", " + text_of(gap_of(segments)) +
                                     " m apart; a ring may have a gap of " + text_of(closed_gap * L) +
                                     " m: close the curve, or leave \"closed\" out");
  const std::vector<Corner> seam =
      corners_of(std::array{segments.back(), segments.front()}, default_corner_angle);
  if (!seam.empty())
    return findings.error(where, "is true, but the axis has a corner of " +
                                     text_of(seam[0].angle * 180 / std::numbers::pi) +
                                     " degrees at its seam, " + text_of(start) +
                                     "; a ring is smooth: round the corner, or leave \"closed\" out");
  if (segments.size() == 1) {
    const auto [first, second] = segments[0].split(0.5);
    segments = {first, second};
  }
  Eigen::Matrix4d points = segments.back().points();
  points.col(3).head<3>() = points(3, 3) * start;
  segments.back() = RationalCubic(points);
  const std::vector<RationalCubic> smooth =
      without_kinks(beam, std::array{segments.back(), segments.front()}, findings);
  segments.back() = smooth[0];
  segments.front() = smooth[1];
}

void mention_closed_axis(const CaseBeam& beam, const std::vector<RationalCubic>& segments,
                         Findings& findings) {
  const double gap = gap_of(segments);
  if (gap <= closed_gap * polygons_length(segments) && gap <= closed_gap * total_length(segments))
    findings.warn(beam.path + ".axis", "is closed; the beam is open at its seam, " +
                                           text_of(segments.front().control_point(0)) +
                                           ": \"closed\": true makes it a ring");
}

// Where the axis comes from, for messages.
std::string origin_of(const BeamAxis& axis) {
  return axis.source ? "the curve " + in_quotes(axis.curve_name) + " of " + axis.source->file.string()
                     : "the axis";
}

// Pieces of an axis that are no longer are left out [m]. Nothing is measured where all clearly are.
double sliver_length(const std::vector<RationalCubic>& segments) {
  constexpr double sliver = 1e-7;  // of the length
  const double at_most = sliver * polygons_length(segments);
  const bool all_longer = std::all_of(segments.begin(), segments.end(), [&](const RationalCubic& cubic) {
    return (cubic.control_point(3) - cubic.control_point(0)).norm() > at_most;
  });
  return all_longer ? at_most : sliver * total_length(segments);
}

// The axis without what has no length or no speed.
std::vector<RationalCubic> regular(const CaseBeam& beam, const BeamAxis& axis, Findings& findings) {
  const RegularSegments regular =
      regular_segments(axis.segments, sliver_length(axis.segments),
                       approximation_tolerance(beam, total_length(axis.segments)));
  if (regular.dropped + regular.replaced > 0)
    findings.warn(beam.path + ".axis",
                  origin_of(axis) + " was made regular: " + std::to_string(regular.dropped) +
                      " pieces shorter than 1e-7 of it left out, " + std::to_string(regular.replaced) +
                      " that stand still at an end made anew; largest deviation " +
                      text_of(regular.deviation) + " m");
  return regular.segments;
}

std::vector<RationalCubic> smoothed(const CaseBeam& beam, const std::vector<RationalCubic>& segments,
                                    Findings& findings) {
  SmoothCorners smooth = smooth_corners(segments, beam.smooth_angle);
  if (smooth.deviation > round_off * total_length(segments))
    findings.warn(beam.path + ".corners",
                  "corners of up to " + text_of(beam.smooth_angle * 180 / std::numbers::pi) +
                      " degrees were smoothed; largest deviation " + text_of(smooth.deviation) + " m");
  return smooth.segments;
}

// How to be without a corner.
std::string rounding(const Corner& corner) {
  constexpr int most_degrees = 45;  // that "smooth_up_to" may be
  const int degrees = static_cast<int>(std::ceil(corner.angle * 180 / std::numbers::pi));
  if (degrees >= most_degrees) return "round the corner";
  return "round the corner, in the drawing or with \"corners\": \"smooth\", \"smooth_up_to\": " +
         std::to_string(degrees);
}

std::string degrees_of(double angle) { return text_of(angle * 180 / std::numbers::pi); }

// The corners of an axis in words: one with its place; of several their number, angles, and the first place.
std::string named(const std::vector<Corner>& corners) {
  const Corner& first = corners.front();
  if (corners.size() == 1)
    return "the axis has a corner of " + degrees_of(first.angle) + " degrees at " + text_of(first.point) +
           "; ";
  const auto [least, most] = std::ranges::minmax_element(corners, {}, &Corner::angle);
  constexpr int digits = 4;
  const auto rough = [](double angle) { return text_of(angle * 180 / std::numbers::pi, digits); };
  return "the axis has " + std::to_string(corners.size()) + " corners, of " + rough(least->angle) + " to " +
         rough(most->angle) + " degrees, the first at " + text_of(first.point) + "; ";
}

// What was meant by points with a corner at each: a bent tube, or a smooth curve.
std::string smooth_curve(const CaseBeam& beam, std::size_t corners) {
  const auto* polyline = std::get_if<CaseAxis::Polyline>(&beam.axis.source);
  constexpr std::size_t few = 2;
  if (!polyline) return "";
  const std::string bends = "give the lines a \"bend_radius\", as a bent tube has, ";
  if (corners <= few) return bends;
  return bends +
         "give the points as \"through\" in place of \"polyline\", which lays a smooth curve through them "
         "(in Python Curve.through), ";
}

// The breaks that stay corners; an error for those that cannot.
std::vector<int> kept_corners(const CaseBeam& beam, const std::vector<RationalCubic>& segments, bool slides,
                              Findings& findings) {
  const std::vector<Corner> found = corners_of(segments, default_corner_angle);
  std::vector<int> corners;
  for (const Corner& corner : found) corners.push_back(corner.after_segment + 1);
  const bool is_rigid = beam.corners == Corners::rigid, keeps = is_rigid || beam.corners == Corners::hinge;
  if (found.empty() || (keeps && !slides)) return corners;
  const Corner& greatest = *std::ranges::max_element(found, {}, &Corner::angle);
  if (keeps) {
    findings.error(beam.path + ".corners",
                   named(found) + "a body cannot slide over a " + (is_rigid ? "rigid corner" : "hinge") +
                       ": " + smooth_curve(beam, found.size()) + rounding(greatest) +
                       ", or divide the beam there and join the parts with \"joints\"");
    return corners;
  }
  findings.error(beam.path + (beam.corners == Corners::smooth ? ".corners" : ".axis"),
                 named(found) +
                     (beam.smooth_angle > 0 ? "those of up to " + degrees_of(beam.smooth_angle) +
                                                  " degrees are smoothed (\"smooth_up_to\"): "
                                            : "a beam needs a smooth axis: ") +
                     smooth_curve(beam, found.size()) + rounding(greatest) +
                     (beam.ring || beam.rigid
                          ? ""
                          : ", or keep it with \"corners\": \"rigid\" (its angle stays) or \"hinge\""));
  return corners;
}

// Whether eyelets may lead the beam round corners of its drawing: its material has none.
bool bends_round_eyelets(const CaseBeam& beam) {
  return beam.stress_free == StressFree::straight && beam.corners == Corners::error && !beam.ring &&
         beam.smooth_angle == 0;
}

}  // namespace

BeamAxis drawn_axis(const CaseBeam& beam, const Chain& chain, CadFiles& files, Findings& findings) {
  return std::visit(
      [&](const auto& source) -> BeamAxis {
        using Source = std::decay_t<decltype(source)>;
        if constexpr (std::is_same_v<Source, AxisFile>)
          return axis_from_file(beam, source, chain, files, findings);
        if constexpr (std::is_same_v<Source, NurbsCurve>)
          return {
              beam.name,
              cubics_of(beam, BezierPath::from_nurbs(source, approximation_tolerance(beam, length(source))),
                        source.degree() > 3, findings)};
        if constexpr (std::is_same_v<Source, CaseAxis::Arc>)
          return {beam.name, arc_cubics(source.center, source.start, source.end, source.normal)};
        if constexpr (std::is_same_v<Source, BentLines>) return {beam.name, bent_line_cubics(source)};
        if constexpr (std::is_same_v<Source, CaseAxis::Polyline>) {
          std::vector<RationalCubic> cubics;
          for (std::size_t i = 0; i + 1 < source.size(); ++i)
            cubics.push_back(line_cubic(source[i], source[i + 1]));
          return {beam.name, std::move(cubics)};
        }
      },
      beam.axis.source);
}

double approximation_tolerance(const CaseBeam& beam, double length) {
  constexpr double most = 1e-6;
  return beam.approximation_tolerance.value_or(most * std::min(1.0, length));
}

double approximation_tolerance(const CaseBeam& beam, const std::vector<NurbsCurve>& curves,
                               const Chain& chain) {
  double sum = 0;
  for (const int curve : chain.curves) sum += length(curves[static_cast<std::size_t>(curve)]);
  return approximation_tolerance(beam, sum);
}

BeamAxis beam_axis(const CaseBeam& beam, const Chain& chain, const Sliders& sliders, CadFiles& files,
                   Findings& findings) {
  BeamAxis axis;
  try {
    axis = drawn_axis(beam, chain, files, findings);
    check_extent(beam, axis.segments, findings);
  } catch (const std::invalid_argument& problem) {
    findings.error(beam.path + ".axis", problem.what());
  }
  if (!findings.has_errors()) axis.segments = regular(beam, axis, findings);
  if (!findings.has_errors()) axis.segments = without_kinks(beam, axis.segments, findings);
  if (!findings.has_errors() && beam.smooth_angle > 0)
    axis.segments = smoothed(beam, axis.segments, findings);
  if (!findings.has_errors() && beam.ring) {
    check_ring(beam, findings);
    close_ring(beam, axis.segments, findings);
  }
  if (!findings.has_errors() && !beam.ring) mention_closed_axis(beam, axis.segments, findings);
  if (findings.has_errors()) return axis;
  if (sliders.eyelets && bends_round_eyelets(beam))
    axis.led_corners = corners_of(axis.segments, default_corner_angle);
  else
    axis.corners = kept_corners(beam, axis.segments, sliders.bodies > 0, findings);
  return axis;
}

}  // namespace nurbeam
