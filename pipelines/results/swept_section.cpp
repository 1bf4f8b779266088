#include "pipelines/results/swept_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fem/element/section_frame.h"
#include "nurbs/interpolated_cubic.h"
#include "nurbs/number_text.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {
namespace {

constexpr double smooth = 1e-2;  // [rad]; small angles of a drawing are smoothed

struct Station {
  Eigen::Vector3d centre, d1, d2;

  Eigen::Vector3d at(const Eigen::Vector2d& place) const { return centre + across(place); }
  Eigen::Vector3d across(const Eigen::Vector2d& place) const { return place.x() * d1 + place.y() * d2; }
  SectionTriad<double> triad() const { return {d1, d2, d1.cross(d2)}; }
};

Station station(const ElementRecord& e, int i) {
  return {RationalCubic(e.control_points).point(i / 3.0), e.d1.col(i), e.d2.col(i)};
}

double turn_between(const SectionTriad<double>& a, const SectionTriad<double>& b) {
  return std::max({(a.d1 - b.d1).norm(), (a.d2 - b.d2).norm(), (a.t - b.t).norm()});
}

// Whether sections go on from one to the other, or meet in a mitre.
bool goes_on(const Station& a, const Station& b) { return turn_between(a.triad(), b.triad()) < smooth; }
bool meets(const Station& a, const Station& b) {
  constexpr double sharpest = -0.9;  // cosine
  const SectionTriad<double> from = a.triad(), to = b.triad();
  return from.t.dot(to.t) > sharpest && turn_between(carried_section<double>(from, to.t, 0.0), to) < smooth;
}

// The sections between two corners, at increasing parameters: chords summed up.
struct Run {
  std::vector<double> parameters;
  std::vector<Station> stations;

  void add(const Station& next) {
    const double chord = stations.empty() ? 0 : (next.centre - stations.back().centre).norm();
    parameters.push_back(parameters.empty() ? 0 : parameters.back() + chord);
    stations.push_back(next);
  }
};

// Where the material line of a section leaves it along the tangent t to meet that beyond a corner.
Eigen::Vector3d at_mitre(const Station& section, const Eigen::Vector2d& place, const Eigen::Vector3d& t,
                         const Eigen::Vector3d& t_beyond) {
  const double reach = section.across(place).dot(t_beyond) / (1 + t.dot(t_beyond));
  return section.at(place) - reach * t;
}

// A beam as runs from corner to corner; a ring's last section is its first.
class Runs {
 public:
  explicit Runs(const BeamRecord& beam) : runs_(1) {
    for (const ElementRecord& e : beam.elements) {
      const bool first = &e == beam.elements.data();
      if (!first && !goes_on(runs_.back().stations.back(), station(e, 0))) runs_.emplace_back();
      for (int i = runs_.back().stations.empty() ? 0 : 1; i < 4; ++i) runs_.back().add(station(e, i));
    }
    Station& last = runs_.back().stations.back();
    const Station& start = runs_.front().stations.front();
    closed_ = (last.centre - start.centre).norm() < 1e-9 * beam.length;
    if (closed_ && goes_on(last, start)) last = start;
  }

  // The curves of the runs on end, the knots at corners of full multiplicity.
  NurbsCurve line(const Eigen::Vector2d& place) const {
    std::vector<double> knots;
    Eigen::Matrix3Xd poles(3, 0);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const NurbsCurve part = mitred(i, place);
      const std::vector<double>& own = part.knots().knots();
      const double from = knots.empty() ? 0 : knots.back();
      const Eigen::Index known = poles.cols(), more = part.control_points().cols() - (i > 0 ? 1 : 0);
      if (i > 0) knots.pop_back();
      for (std::size_t k = i > 0 ? 4 : 0; k < own.size(); ++k) knots.push_back(from + own[k]);
      poles.conservativeResize(3, known + more);
      poles.rightCols(more) = part.control_points().topRows<3>().rightCols(more);
    }
    return make_nurbs_curve(KnotVector(3, std::move(knots)), poles, Eigen::VectorXd::Ones(poles.cols()));
  }

 private:
  // The neighbour's section beyond an end of a run that is a corner.
  const Station* beyond(std::size_t i, bool at_end) const {
    const std::size_t n = runs_.size(), next = at_end ? (i + 1) % n : (i + n - 1) % n;
    if (at_end ? i + 1 == n : i == 0) {
      if (!closed_) return nullptr;
      const Station &a = runs_.back().stations.back(), &b = runs_.front().stations.front();
      if (goes_on(a, b)) return nullptr;
    }
    return at_end ? &runs_[next].stations.front() : &runs_[next].stations.back();
  }

  // The line of a run between its corners: on that of the sections, cut back or extended to the mitre, by
  // less and less towards the middle of the run.
  NurbsCurve mitred(std::size_t i, const Eigen::Vector2d& place) const {
    const Run& run = runs_[i];
    const std::size_t n = run.stations.size();
    Eigen::Matrix3Xd points(3, n);
    for (std::size_t k = 0; k < n; ++k) points.col(static_cast<int>(k)) = run.stations[k].at(place);
    const NurbsCurve whole = interpolated_cubic(run.parameters, points);
    for (const bool at_end : {false, true}) {
      const Station* const other = beyond(i, at_end);
      if (!other) continue;
      const Station& own = at_end ? run.stations.back() : run.stations.front();
      const Eigen::Vector3d outwards = (at_end ? 1 : -1) * own.triad().t,
                            onwards = (at_end ? 1 : -1) * other->triad().t;
      const Eigen::Vector3d corner = at_mitre(own, place, outwards, onwards);
      const double length = run.parameters.back(), end = at_end ? length : 0;
      const double reach = (corner - own.at(place)).dot(outwards);
      for (std::size_t k = 0; k < n; ++k) {
        const double share = std::max(0.0, 1 - 2 * std::abs(run.parameters[k] - end) / length);
        if (share == 0) continue;
        const double moved = run.parameters[k] + (at_end ? 1 : -1) * share * reach;
        const double inside = std::clamp(moved, 0.0, length);
        points.col(static_cast<int>(k)) = whole.point(inside) + std::abs(moved - inside) * outwards;
      }
      points.col(at_end ? static_cast<int>(n) - 1 : 0) = corner;
    }
    return interpolated_cubic(run.parameters, points);
  }

  std::vector<Run> runs_;
  bool closed_;
};

Eigen::Vector2d flat(const Eigen::Vector3d& p) { return p.head<2>(); }

// A direction in which the cubic begins, or ends.
Eigen::Vector2d direction(const RationalCubic& cubic, bool at_end) {
  return flat(cubic.derivatives(at_end ? 1 : 0).col(1)).normalized();
}

}  // namespace

std::optional<std::string> sweeping_obstacle(const BeamRecord& beam) {
  const auto refusal = [](double s) {
    return "it has a corner at s = " + text_of(s) + " m over which its sections do not meet in a mitre";
  };
  for (std::size_t i = 0; i < beam.elements.size(); ++i) {
    const ElementRecord& e = beam.elements[i];
    if (e.d1.hasNaN()) return "it has no torsion, so that its sections have no orientation";
    if (i == 0) continue;
    const Station before = station(beam.elements[i - 1], 3), after = station(e, 0);
    if (!goes_on(before, after) && !meets(before, after)) return refusal(e.s_start);
  }
  const Station first = station(beam.elements.front(), 0), last = station(beam.elements.back(), 3);
  if ((first.centre - last.centre).norm() < 1e-9 * beam.length && !goes_on(last, first) &&
      !meets(last, first))
    return refusal(beam.elements.back().s_end);
  return {};
}

NurbsCurve section_line(const BeamRecord& beam, const Eigen::Vector2d& place) {
  return Runs(beam).line(place);
}

SweptProfile swept_section(const BeamRecord& beam, const std::vector<Loop>& profile, double area,
                           const std::string& name, const std::string& part) {
  const Runs runs(beam);
  SweptProfile swept{name, part, {}, area * beam.length};
  for (const Loop& loop : profile) {
    std::vector<SweptCubic>& cubics = swept.loops.emplace_back();
    for (const RationalCubic& cubic : loop) {
      const auto rail = [&](int k) { return runs.line(flat(cubic.control_point(k))); };
      cubics.push_back({{rail(0), rail(1), rail(2), rail(3)},
                        {cubic.weight(0), cubic.weight(1), cubic.weight(2), cubic.weight(3)}});
    }
  }
  return swept;
}

std::vector<Eigen::Vector2d> marked_places(const std::vector<Loop>& profile) {
  constexpr double sharp = 0.17;  // [rad]
  std::vector<Eigen::Vector2d> corners, farthest(4, Eigen::Vector2d::Zero());
  constexpr std::pair<double, double> axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (const Loop& loop : profile)
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Eigen::Vector2d a = direction(loop[j], true), b = direction(loop[(j + 1) % loop.size()], false);
      if (std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))) > sharp)
        corners.push_back(flat(loop[j].control_point(3)));
      constexpr int parts = 32;
      for (int i = 0; i < parts; ++i)
        for (int k = 0; k < 4; ++k) {
          const Eigen::Vector2d p = flat(loop[j].point(static_cast<double>(i) / parts)),
                                axis(axes[k].first, axes[k].second);
          if (p.dot(axis) > farthest[k].dot(axis)) farthest[k] = p;
        }
    }
  return corners.empty() ? farthest : corners;
}

}  // namespace nurbeam
