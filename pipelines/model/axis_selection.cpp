#include "pipelines/model/axis_selection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <set>

#include "nurbs/closest_point.h"
#include "nurbs/curve_vertices.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/curve_choice.h"

namespace nurbeam {

namespace {

using Indices = std::vector<int>;

// Gaps below this part of the curves' size are round-off.
constexpr double negligible = 1e-12;

AxisSelection failure(std::string key, std::string error) {
  return {{}, {}, std::move(key), std::move(error)};
}

// The diagonal of the box around all control points [m].
double size_of(const ImportReport& report) {
  Eigen::AlignedBox3d box;
  for (const ImportedCurve& imported : report.curves) {
    const Eigen::Matrix3Xd points = imported.curve.control_points().colwise().hnormalized();
    box.extend(points.rowwise().minCoeff()).extend(points.rowwise().maxCoeff());
  }
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

Indices all_curves(const ImportReport& report) {
  Indices all(report.curves.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

template <class Predicate>
Indices those(const ImportReport& report, const Indices& indices, Predicate wanted) {
  Indices found;
  for (int i : indices)
    if (wanted(report.curves[i])) found.push_back(i);
  return found;
}

// Free curves before centre lines before edges of faces.
Indices that_count(const ImportReport& report, const Indices& all) {
  const Indices candidates = those(
      report, all, [](const ImportedCurve& c) { return !c.hidden; });
  const Indices free = those(report, candidates, [](const ImportedCurve& c) { return c.free; });
  if (!free.empty()) return free;
  const Indices centre = those(report, candidates, [](const ImportedCurve& c) { return c.is_centre_line(); });
  return centre.empty() ? candidates : centre;
}

std::vector<NurbsCurve> curves_at(const ImportReport& report, const Indices& indices) {
  std::vector<NurbsCurve> curves;
  for (int i : indices) curves.push_back(report.curves[i].curve);
  return curves;
}

std::vector<Chain> chains_among(const ImportReport& report, const Indices& indices, double tolerance) {
  std::vector<Chain> chains = find_chains(curves_at(report, indices), tolerance);
  for (Chain& chain : chains)
    for (int& curve : chain.curves) curve = indices[curve];
  return chains;
}

double length_of(const Chain& chain, const ImportReport& report) {
  double sum = 0;
  for (int curve : chain.curves) sum += length(report.curves[curve].curve);
  return sum;
}

double distance_to(const Chain& chain, const Eigen::Vector3d& point, const ImportReport& report) {
  double least = std::numeric_limits<double>::infinity();
  for (int i : chain.curves) {
    const NurbsCurve& curve = report.curves[i].curve;
    const BezierPath path = BezierPath::from_nurbs(curve, 1e-6 * length(curve));
    least = std::min(least, closest_point(path.segments, point).distance);
  }
  return least;
}

// The first of the chains for which the measure is least.
template <class Measure>
Chain least(const std::vector<Chain>& chains, Measure measure) {
  std::vector<double> measured;
  for (const Chain& chain : chains) measured.push_back(measure(chain));
  return chains[std::min_element(measured.begin(), measured.end()) - measured.begin()];
}

// The direction into the curve from its start or its end: to the next control point that is not the end
// itself, as a spline may stand still there.
Eigen::Vector3d inward_direction(const NurbsCurve& curve, bool from_end) {
  constexpr double standing_still = 1e-9;  // of the control polygon
  const KnotVector& knots = curve.knots();
  const int span = knots.find_span(from_end ? knots.end() : knots.start());
  Eigen::Matrix3Xd points = curve.bezier_points(span).colwise().hnormalized();
  if (from_end) points = points.rowwise().reverse().eval();
  const Eigen::Matrix3Xd legs = points.rightCols(points.cols() - 1).colwise() - points.col(0);
  const Eigen::RowVectorXd lengths = legs.colwise().norm();
  Eigen::Index i = 0;
  while (i + 1 < lengths.size() && lengths(i) <= standing_still * lengths.maxCoeff()) ++i;
  return legs.col(i).normalized();
}

// Whether a curve of the chain goes on into the next one, after the last into the first, without a corner.
bool goes_on_smoothly(const Chain& chain, std::size_t i, const ImportReport& report) {
  const std::size_t j = (i + 1) % chain.curves.size();
  const Eigen::Vector3d back = inward_direction(report.curves[chain.curves[i]].curve, !chain.reversed[i]);
  const Eigen::Vector3d on = inward_direction(report.curves[chain.curves[j]].curve, chain.reversed[j]);
  return (on + back).norm() < default_corner_angle;
}

// The closed chain begun behind a corner, so that none of its smooth runs goes on past its ends; without a
// corner it stays as it is.
Chain begun_behind_a_corner(Chain chain, const ImportReport& report) {
  const std::size_t count = chain.curves.size();
  std::size_t corner = 0;
  while (corner < count && goes_on_smoothly(chain, corner, report)) ++corner;
  const auto first = static_cast<std::ptrdiff_t>(corner < count ? (corner + 1) % count : 0);
  std::rotate(chain.curves.begin(), chain.curves.begin() + first, chain.curves.end());
  std::rotate(chain.reversed.begin(), chain.reversed.begin() + first, chain.reversed.end());
  return chain;
}

// The connected curves that continue without a corner on both sides of one curve.
Chain smooth_chain_around(const ImportReport& report, const Indices& candidates, int chosen,
                          double tolerance) {
  for (const Chain& whole : chains_among(report, candidates, tolerance)) {
    if (std::find(whole.curves.begin(), whole.curves.end(), chosen) == whole.curves.end()) continue;
    const Chain chain = whole.closed ? begun_behind_a_corner(whole, report) : whole;
    const auto smooth = [&](std::size_t i) { return goes_on_smoothly(chain, i, report); };
    const auto at = std::find(chain.curves.begin(), chain.curves.end(), chosen);
    std::size_t first = at - chain.curves.begin(), last = first;
    while (first > 0 && smooth(first - 1)) --first;
    while (last + 1 < chain.curves.size() && smooth(last)) ++last;
    return {{chain.curves.begin() + first, chain.curves.begin() + last + 1},
            {chain.reversed.begin() + first, chain.reversed.begin() + last + 1},
            chain.closed && last - first + 1 == chain.curves.size()};
  }
  return {{chosen}, {false}, false};
}

// The gaps between consecutive curves of the chains.
std::vector<Gap> gaps_in(const std::vector<Chain>& chains, const ImportReport& report) {
  const double least = negligible * size_of(report);
  std::vector<Gap> gaps;
  for (const Chain& chain : chains) {
    const std::size_t count = chain.curves.size();
    for (std::size_t i = 0; i + (chain.closed ? 0 : 1) < count; ++i) {
      const std::size_t j = (i + 1) % count;
      const auto end = [&](std::size_t k, bool last) -> Eigen::Vector3d {
        const NurbsCurve& curve = report.curves[chain.curves[k]].curve;
        return curve.point(last != chain.reversed[k] ? curve.knots().end() : curve.knots().start());
      };
      const Eigen::Vector3d a = end(i, true), b = end(j, false);
      if ((a - b).norm() > least)
        gaps.push_back({chain.curves[i], chain.curves[j], (a + b) / 2, (a - b).norm()});
    }
  }
  return gaps;
}

// The narrowest gap between ends of chains, up to a hundredth of the curves' size: most likely not meant.
std::optional<Gap> narrowest_gap_between(const std::vector<Chain>& chains, const ImportReport& report) {
  struct End {
    int curve;
    Eigen::Vector3d point;
  };
  std::vector<End> ends;
  for (const Chain& chain : chains) {
    if (chain.closed) continue;
    for (const auto& [k, last] : {std::pair{std::size_t{0}, false}, {chain.curves.size() - 1, true}}) {
      const NurbsCurve& curve = report.curves[chain.curves[k]].curve;
      const double u = last != chain.reversed[k] ? curve.knots().end() : curve.knots().start();
      ends.push_back({chain.curves[k], curve.point(u)});
    }
  }
  constexpr std::size_t most_ends = 2000;  // all pairs are compared
  if (ends.size() > most_ends) return {};
  std::optional<Gap> narrowest;
  double width = 1e-2 * size_of(report);
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = (ends[i].point - ends[j].point).norm();
      if (ends[i].curve == ends[j].curve || distance == 0 || distance >= width) continue;
      width = distance;
      narrowest = Gap{ends[j].curve, ends[i].curve, (ends[i].point + ends[j].point) / 2, distance};
    }
  return narrowest;
}

std::string several_chains(const std::vector<Chain>& chains, const ImportReport& report, double tolerance) {
  std::string message =
      report.file + " has " + std::to_string(chains.size()) + " separate chains of curves: ";
  constexpr std::size_t most_listed = 10;
  for (std::size_t i = 0; i < std::min(chains.size(), most_listed); ++i)
    message += (i > 0 ? "; " : "") + list_of_curves(report, chains[i].curves) + " (" +
               text_of(length_of(chains[i], report), all_digits) + " m)";
  if (chains.size() > most_listed) message += "; ...";
  message +=
      "; choose one with \"curve\", \"part\", \"layer\", \"colour\", \"near\" or \"longest\", or take \"chains\": "
      "\"all\"";
  const std::optional<Gap> gap = narrowest_gap_between(chains, report);
  if (gap && gap->width > tolerance)
    message += "; curves " + std::to_string(gap->curve_a + 1) + " and " + std::to_string(gap->curve_b + 1) +
               " end " + text_of(gap->width, all_digits) + " m apart at " + text_of(gap->point, all_digits) +
               ", and gaps up to " + text_of(tolerance, all_digits) + " m are closed (\"gap\")";
  return message;
}

// The one curve that is named; when several have the name, their chain.
AxisSelection named(const AxisFile& axis, const ImportReport& report, const Indices& candidates,
                    double tolerance) {
  Indices found;
  if (axis.curve_index) {
    const int index = *axis.curve_index - 1, count = static_cast<int>(report.curves.size());
    if (index >= count)
      return failure("curve", "index " + std::to_string(*axis.curve_index) +
                                  " is out of range: " + report.file + " has " + std::to_string(count) +
                                  (count == 1 ? " curve: " : " curves: ") +
                                  list_of_curves(report, all_curves(report)));
    if (std::find(candidates.begin(), candidates.end(), index) == candidates.end())
      return failure("curve", "index " + std::to_string(*axis.curve_index) +
                                  " is not among the curves of the part, layer and colour: " +
                                  list_of_curves(report, candidates));
    found = {index};
  } else {
    found = those(report, candidates, [&](const ImportedCurve& c) { return c.name == *axis.curve_name; });
    if (found.empty()) {
      std::vector<std::string> names;
      for (const int i : candidates)
        if (!report.curves[i].name.empty()) names.push_back(report.curves[i].name);
      const std::string question = nearest_question(*axis.curve_name, names);
      return failure("curve", "no curve is named " + in_quotes(*axis.curve_name) + " in " + report.file +
                                  (question.empty() ? "; its" : question + " Its") +
                                  " curves (index and name): " + list_of_curves(report, candidates));
    }
  }
  if (found.size() == 1)
    return {{axis.chain ? smooth_chain_around(report, candidates, found[0], tolerance)
                        : Chain{found, {false}, false}},
            {},
            "",
            ""};
  const std::vector<Chain> chains = chains_among(report, found, tolerance);
  if (chains.size() == 1) return {chains, {}, "", ""};
  return failure("curve", "several curves are named " + in_quotes(*axis.curve_name) + " in " + report.file +
                              " and are no one chain: " + list_of_curves(report, found) +
                              "; choose one by its index");
}

AxisSelection chosen_chains(const AxisFile& axis, const ImportReport& report, double tolerance) {
  const ChosenCurves chosen = chosen_curves(axis.choice(), report);
  if (!chosen.error.empty()) return failure(chosen.key, chosen.error);
  const Indices& candidates = chosen.indices;
  if (axis.curve_index || axis.curve_name) return named(axis, report, candidates, tolerance);
  const std::vector<Chain> chains = chains_among(report, that_count(report, candidates), tolerance);
  if (chains.empty())
    return failure("", "every curve of " + report.file + " that is left to choose from is hidden: " +
                           list_of_curves(report, candidates) + "; name one with \"curve\"");
  if (axis.near)
    return {{least(chains, [&](const Chain& c) { return distance_to(c, *axis.near, report); })}, {}, "", ""};
  if (axis.longest)
    return {{least(chains, [&](const Chain& c) { return -length_of(c, report); })}, {}, "", ""};
  if (axis.all_chains || chains.size() == 1) return {chains, {}, "", ""};
  return failure("", several_chains(chains, report, tolerance));
}

}  // namespace

double gap_tolerance(const ImportReport& report, const std::optional<double>& asked) {
  if (asked) return *asked;
  const double size = size_of(report);
  if (report.resolution == 0) return 1e-6 * size;
  return std::clamp(report.resolution, 1e-9 * size, 1e-3 * size);
}

AxisSelection select_axis(const AxisFile& axis, const ImportReport& report) {
  AxisSelection selection = chosen_chains(axis, report, gap_tolerance(report, axis.gap));
  selection.gaps = gaps_in(selection.chains, report);
  return selection;
}

std::vector<Junction> junctions(const ImportReport& report, double tolerance) {
  const Indices indices = that_count(report, all_curves(report));
  const bool edges_of_faces =
      !indices.empty() && !report.curves[indices[0]].free && !report.curves[indices[0]].is_centre_line();
  if (edges_of_faces) return {};
  std::vector<Junction> found;
  for (const CurveVertex& vertex : vertices_of(curves_at(report, indices), tolerance)) {
    if (vertex.ends.size() < 3) continue;
    std::set<int> curves;
    for (const CurveEnd& end : vertex.ends) curves.insert(indices[end.curve]);
    found.push_back({vertex.point, {curves.begin(), curves.end()}});
  }
  return found;
}

std::vector<Chain> chains_of(const ImportReport& report, double tolerance) {
  return chains_among(report, that_count(report, all_curves(report)), tolerance);
}

std::string list_of_curves(const ImportReport& report, std::vector<int> indices) {
  std::sort(indices.begin(), indices.end());
  constexpr int most_listed = 20;
  std::string list;
  int listed = 0;
  for (std::size_t i = 0; i < indices.size(); ++listed) {
    if (!list.empty()) list += ", ";
    if (listed == most_listed) return list + "...";
    const auto is_plain = [&](std::size_t k) { return report.curves[indices[k]].name.empty(); };
    std::size_t last = i;
    while (is_plain(i) && last + 1 < indices.size() && is_plain(last + 1) &&
           indices[last + 1] == indices[last] + 1)
      ++last;
    list += std::to_string(indices[i] + 1);
    if (last > i) list += "-" + std::to_string(indices[last] + 1);
    if (!is_plain(i)) list += " " + in_quotes(report.curves[indices[i]].name);
    i = last + 1;
  }
  return list;
}

}  // namespace nurbeam
