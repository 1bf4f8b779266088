#include "cad_import/step/tube_panels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nurbeam::tubes {
namespace {

Node node_at(const NurbsCurve& span, double u) {
  const Eigen::Matrix3Xd d = span.derivatives(u, 2);
  return {.parameter = u, .centre = d.col(0), .rate = d.col(1), .acceleration = d.col(2)};
}

/// How far the cubic of a panel is from the curve, midway.
double deviation(const NurbsCurve& span, const Panel& panel) {
  const double h = panel.to.parameter - panel.from.parameter;
  const Eigen::Vector3d middle =
      0.5 * (panel.from.centre + panel.to.centre) + h / 8 * (panel.from.rate - panel.to.rate);
  return (middle - span.point(panel.from.parameter + 0.5 * h)).norm();
}

/// So many panels that each turns little and is near to the curve.
std::vector<Panel> panels_of(const NurbsCurve& span, double radius) {
  constexpr double most_turn = 0.03;  // [rad]
  constexpr int most = 1024;
  const double a = span.knots().start(), length = span.knots().end() - a;
  for (int count = 1;; count *= 2) {
    std::vector<Panel> panels;
    bool fine = true;
    for (int i = 0; i < count; ++i) {
      panels.push_back({node_at(span, a + length * i / count), node_at(span, a + length * (i + 1) / count)});
      const Node &from = panels.back().from, &to = panels.back().to;
      const double turn = std::max(from.tangent_rate().norm(), to.tangent_rate().norm()) * length / count;
      fine = fine && turn <= most_turn && deviation(span, panels.back()) <= 1e-8 * radius;
    }
    if (fine || count >= most) return panels;
  }
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
