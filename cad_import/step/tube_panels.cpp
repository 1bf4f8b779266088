#include "cad_import/step/tube_panels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nurbeam::tubes {
namespace {

Node node_at(const NurbsCurve& span, double u) {
  const Eigen::Matrix3Xd d = span.derivatives(u, 2);
  return {.parameter = u, .centre = d.col(0), .rate = d.col(1), .acceleration = d.col(2)};
}

/// A place on the panel, a part of the way along it: of the section (x across, y along).
Eigen::Vector3d place_on(const Panel& panel, double part, double x, double y) {
  const auto [a, b, c, d] = panel.poles(x, y);
  const double v = part, w = 1 - part;
  return w * w * w * a + 3 * v * w * (w * b + v * c) + v * v * v * d;
}

/// Whether the panel's wall, and places along it, are where they should be: looked at along and round it.
bool is_near(const NurbsCurve& span, Panel panel, double radius) {
  constexpr double near = 1e-7, even = 1e-6;  // of the radius, of the panel
  constexpr int along = 4, round = 8;
  panel.from.set_section(panel.from.tangent().unitOrthogonal());
  panel.to.set_section(carried(panel.from.across, panel.from, panel.to));
  for (int i = 1; i < along; ++i) {
    const double part = static_cast<double>(i) / along;
    const Node there = node_at(span, std::lerp(panel.from.parameter, panel.to.parameter, part));
    if ((place_on(panel, part, 0, 0) - there.centre).norm() > even * chord(panel)) return false;
    for (int k = 0; k < round; ++k) {
      const double angle = 2 * std::numbers::pi * k / round;
      const Eigen::Vector3d wall = place_on(panel, part, radius * std::cos(angle), radius * std::sin(angle));
      const double distance = there.tangent().cross(wall - there.centre).norm();
      if (std::abs(distance - radius) > near * radius) return false;
    }
  }
  return true;
}

/// The panel, or its halves, their halves ... that are near to the tube.
void add_near(const NurbsCurve& span, const Panel& panel, double radius, int halvings,
              std::vector<Panel>& panels) {
  constexpr int most_halvings = 10;
  if (halvings == most_halvings || is_near(span, panel, radius)) return panels.push_back(panel);
  const Node middle = node_at(span, 0.5 * (panel.from.parameter + panel.to.parameter));
  add_near(span, {panel.from, middle}, radius, halvings + 1, panels);
  add_near(span, {middle, panel.to}, radius, halvings + 1, panels);
}

std::vector<Panel> panels_of(const NurbsCurve& span, double radius) {
  std::vector<Panel> panels;
  add_near(span, {node_at(span, span.knots().start()), node_at(span, span.knots().end())}, radius, 0, panels);
  return panels;
}

/// By how much a section leans over into the mitre of a corner, per its distance across: the tangent of half
/// the angle.
double largest_lean(const Eigen::Vector3d& in, const Eigen::Vector3d& out) {
  return in.cross(out).norm() / (1 + in.dot(out));
}

/// How much of a run's start and end leans.
std::pair<double, double> reaches(const Run& run, double radius) {
  const double start = run.before ? largest_lean(*run.before, run.start_direction()) : 0;
  const double end = run.after ? largest_lean(run.end_direction(), *run.after) : 0;
  return {reach_of_lean(start, radius), reach_of_lean(end, radius)};
}

/// The panel, or its halves, their halves ... that are `longest` where they begin less than `start` from the
/// start of the run or end less than `end` from its end. Before it and behind it are so much of the run.
void add_halved(const NurbsCurve& span, const Panel& panel, double longest, double start, double end,
                double before, double behind, std::vector<Panel>& panels) {
  const bool leans = before < start || behind < end;
  if (!leans || chord(panel) <= longest) return panels.push_back({panel.from, panel.to, leans});
  const Node middle = node_at(span, 0.5 * (panel.from.parameter + panel.to.parameter));
  const Panel first{panel.from, middle}, second{middle, panel.to};
  add_halved(span, first, longest, start, end, before, behind + chord(second), panels);
  add_halved(span, second, longest, start, end, before + chord(first), behind, panels);
}

/// The panels of each span of the run, short where they lean.
std::vector<std::vector<Panel>> panels_of(const Run& run, double radius) {
  std::vector<std::vector<Panel>> spans;
  double behind = 0;
  for (const NurbsCurve& span : run.spans)
    for (const Panel& panel : spans.emplace_back(panels_of(span, radius))) behind += chord(panel);
  const auto [start, end] = reaches(run, radius);
  double before = 0;
  for (std::size_t j = 0; j < spans.size(); ++j) {
    std::vector<Panel> panels;
    for (const Panel& panel : spans[j]) {
      behind -= chord(panel);
      add_halved(run.spans[j], panel, radius, start, end, before, behind, panels);
      before += chord(panel);
    }
    spans[j] = std::move(panels);
  }
  return spans;
}

}  // namespace

Eigen::Vector3d Node::place(double x, double y) const {
  return centre + x * across + y * along + lean.dot(Eigen::Vector2d(x, y)) * forward;
}

Eigen::Vector3d Node::place_rate(double x, double y) const {
  const Eigen::Vector3d t = tangent(), t_rate = tangent_rate();
  const Eigen::Vector3d across_rate = -across.dot(t_rate) * t + twist * along;
  const Eigen::Vector3d along_rate = -along.dot(t_rate) * t - twist * across;
  const Eigen::Vector2d place(x, y);
  return rate + x * across_rate + y * along_rate + lean_rate.dot(place) * t + lean.dot(place) * t_rate;
}

std::array<Eigen::Vector3d, 4> Panel::poles(double x, double y) const {
  const double third = (to.parameter - from.parameter) / 3;
  return {from.place(x, y), from.place(x, y) + third * from.place_rate(x, y),
          to.place(x, y) - third * to.place_rate(x, y), to.place(x, y)};
}

/// By double reflection (Wang and others, 2008).
Eigen::Vector3d carried(const Eigen::Vector3d& across, const Node& from, const Node& to) {
  const auto mirrored = [](const Eigen::Vector3d& v, const Eigen::Vector3d& normal) -> Eigen::Vector3d {
    return v - 2 / normal.squaredNorm() * normal.dot(v) * normal;
  };
  const Eigen::Vector3d chord = to.centre - from.centre;
  const Eigen::Vector3d second = to.tangent() - mirrored(from.tangent(), chord);
  const Eigen::Vector3d half = mirrored(across, chord);
  return second.norm() > 0 ? mirrored(half, second) : half;
}

Panels panels_of(const Spine& spine, double radius) {
  constexpr std::size_t most_in_face = 16;
  Panels panels;
  for (const Run& run : spine.runs) {
    panels.runs.push_back(panels.all.size());
    for (const std::vector<Panel>& own : panels_of(run, radius))
      for (std::size_t i = 0; i < own.size(); ++i) {
        const bool begins = i == 0 || own[i].leans || own[i - 1].leans ||
                            panels.all.size() - panels.faces.back() == most_in_face;
        if (begins) panels.faces.push_back(panels.all.size());
        panels.all.push_back(own[i]);
      }
  }
  panels.runs.push_back(panels.all.size());
  return panels;
}

}  // namespace nurbeam::tubes
