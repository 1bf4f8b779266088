#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fem/element/subdivision.h"
#include "pipelines/papers/papers.h"
#include "pipelines/papers/pendulum_motion.h"
#include "pipelines/papers/raised_arc.h"

// Sections 3 to 6 of [S]: parameter and arc length, and the division of an arc. Geometry alone.
namespace nurbeam::papers {

namespace {

using Eigen::Vector3d;
using Style = PlotLine::Style;

// The arc of Sections 4 to 6, and that of the pendulum, Section 7.
const double wide_radius = 2 * std::numbers::sqrt3 / 3, radius = 0.5;  // [m]
constexpr double wide_half_angle = std::numbers::pi / 3;
constexpr double uneven = 0.5;  // c of raised_arc: end speeds 1 : 4

RationalCubic wide_arc(double c) { return raised_arc(wide_radius, wide_half_angle, c); }

std::vector<double> even_parameters(int n) {
  std::vector<double> u;
  for (int i = 0; i <= n; ++i) u.push_back(static_cast<double>(i) / n);
  return u;
}

std::vector<double> with_ends(std::vector<double> u) {
  u.insert(u.begin(), 0);
  u.push_back(1);
  return u;
}

// Points of a curve r(u), moved outwards from the centre of the arc.
PlotLine outline(const RationalCubic& axis, double R, const std::vector<double>& parameters, double outwards,
                 Style style, const std::string& label) {
  const Vector3d centre(0, R, 0);
  PlotLine drawn{label, {}, {}, style};
  for (double u : parameters) {
    const Vector3d r = centre + (axis.point(u) - centre) * (1 + outwards / R);
    drawn.x.push_back(r.x());
    drawn.y.push_back(r.y());
  }
  return drawn;
}

Plot drawing(const std::string& title) {
  Plot plot{title, "x [m]", "y [m]", {}};
  plot.equal_axes = true;
  return plot;
}

void append(PlotLine& to, const PlotLine& from) {
  to.x.insert(to.x.end(), from.x.begin(), from.x.end());
  to.y.insert(to.y.end(), from.y.begin(), from.y.end());
  to.x.push_back(NAN);  // lifts the pen
  to.y.push_back(NAN);
}

// Adds a divided arc to a drawing.
void add_division(Plot& plot, const RationalCubic& axis, double R, const std::vector<double>& inner,
                  double outwards) {
  if (plot.lines.empty()) plot.lines = {{"arc", {}, {}, Style::line}, {"nodes", {}, {}, Style::marks}};
  append(plot.lines[0], outline(axis, R, even_parameters(40), outwards, Style::line, ""));
  append(plot.lines[1], outline(axis, R, with_ends(inner), outwards, Style::marks, ""));
}

void write_even_parameters(Page& page) {
  Plot plot = drawing("Equal parameter steps (Fig. 3 of [S])");
  for (const auto& [label, c, outwards] :
       {std::tuple{"even", 1.0, 0.0}, {"uneven, end speeds 1 : 4", uneven, 0.12}})
    plot.lines.push_back(
        outline(wide_arc(c), wide_radius, even_parameters(6), outwards, Style::line_and_marks, label));
  page.figure(
      "subdivision_fig03", plot,
      "Fig. 3: six equal steps of u on the arc of 120° and radius 2√3/3 m; the second arc is moved apart "
      "for view. Table 1 of [S], which defines its two elements, is a picture without numbers in its text: "
      "the uneven one is a choice");
}

void write_parameter_map(Page& page) {
  const RationalCubic axis = wide_arc(uneven);
  const ArcLengthMap measured(axis);
  const Speed speed(axis);
  const double L = measured.length();
  Plot map{"Parameter over arc length (Fig. 4 of [S])", "x / L_T", "u, L_T du/dx", {}};
  Plot density{"Density of parameter points (Fig. 5 of [S])", "x / L_T", "D", {}};
  PlotLine u{"u", {0}, {0}}, rate{"L_T du/dx", {}, {}}, D{"uneven arc", {}, {}},
      parts{"eight equal parts", {}, {}, Style::marks};
  for (int i = 0; i <= 100; ++i) {
    const double x = L * i / 100, at = measured.parameter(x);
    rate.x.push_back(i / 100.0);
    rate.y.push_back(L / speed(at));
    if (i == 0) continue;
    u.x.push_back(i / 100.0);
    u.y.push_back(at);
    D.x.push_back(i / 100.0);
    D.y.push_back(parameter_density(measured, x));
  }
  for (int j = 1; j < 8; ++j) {
    parts.x.push_back(j / 8.0);
    parts.y.push_back(measured.parameter(L * j / 8));
  }
  const bool falls = std::is_sorted(rate.y.rbegin(), rate.y.rend()),
             thins = std::is_sorted(D.y.rbegin(), D.y.rend());
  map.lines = {u, rate, parts};
  density.lines = {D};
  page.figure(
      "subdivision_fig04", map,
      std::string("Fig. 4: the uneven arc of Fig. 3, u(x) by adaptive quadrature and Newton's method. As in "
                  "[S], u grows with x everywhere, and its rate ") +
          (falls ? "falls" : "does not fall") + " all along");
  page.figure("subdivision_fig05", density,
              std::string("Fig. 5: D(x) = u(x) L_T / x, without counting parameter points. As in [S], it ") +
                  (thins ? "falls" : "does not fall") + " all along, to " + number(D.y.back(), 6) +
                  " at the end");
}

// Eqs. 13-16 by counting, as [S] does: the arc length of every one of N_T parameter points, by chords.
double largest_miscount(const RationalCubic& axis, int N_T) {
  const ArcLengthMap measured(axis);
  double x = 0, largest = 0;
  Vector3d last = axis.point(0);
  for (int i = 1; i <= N_T; ++i) {
    const Vector3d r = axis.point(static_cast<double>(i) / N_T);
    x += (r - last).norm();
    last = r;
    if (i % (N_T / 1000) == 0)
      largest = std::max(largest, std::abs(static_cast<double>(i) / N_T - measured.parameter(x)));
  }
  return largest;
}

void write_proportions(Page& page) {
  const RationalCubic axis = wide_arc(uneven);
  const ArcLengthMap measured(axis);
  const double L = measured.length();
  Plot share{"Share of the parameter over density (Fig. 6 of [S])", "ΔD of a part", "Δu of the part", {}};
  PlotLine line{"eight equal parts", {}, {}, Style::line_and_marks};
  for (int j = 0; j < 8; ++j) {
    const double du = measured.parameter(L * (j + 1) / 8) - measured.parameter(L * j / 8);
    line.x.push_back(8 * du);  // points of the part over its length, both as shares of the whole
    line.y.push_back(du);
  }
  share.lines = {line};
  page.figure(
      "subdivision_fig06", share,
      "Fig. 6: eight parts of equal length of the uneven arc. By Eqs. 13 and 15 their ΔD is 8 Δu: a straight "
      "line by definition, of which [S] has the slope");
  constexpr int N_T = 1000000;
  Plot counted{"Parameter and number of parameter points (Fig. 7 of [S])", "x / L_T", "u, N / N_T", {}};
  PlotLine u{"u", {}, {}}, N{"N / N_T", {}, {}, Style::dashed};
  for (int i = 0; i <= 50; ++i) {
    const double at = measured.parameter(L * i / 50);
    u.x.push_back(i / 50.0);
    u.y.push_back(at);
    N.x.push_back(i / 50.0);
    N.y.push_back(std::floor(at * N_T) / N_T);
  }
  counted.lines = {u, N};
  page.figure(
      "subdivision_fig07", counted,
      "Fig. 7: with 10⁶ parameter points, as in [S], both curves are one. Counting them along their chords, "
      "u(x) is met within " +
          number(largest_miscount(axis, N_T), 1));
}

void write_graded_arcs(Page& page) {
  const RationalCubic axis = wide_arc(uneven);
  const ArcLengthMap measured(axis);
  const double L = measured.length(), limit = grading_limit(L, 5);
  Plot plot = drawing("Five parts with five factors k (Fig. 9 of [S])");
  double largest = 0;  // |R phi_j - x_j|
  std::string factors;
  for (const double share : {-0.8, -0.4, 0.0, 0.4, 0.8}) {
    const std::vector<double> x = graded_places(L, 5, share * limit),
                              u = graded_parameters(measured, 5, share * limit);
    add_division(plot, axis, wide_radius, u, 0.12 * (share + 0.8) / 0.4);
    factors += (factors.empty() ? "" : ", ") + number(share * limit, 3);
    for (std::size_t j = 0; j < x.size(); ++j) {
      const Vector3d r = axis.point(u[j]);
      largest = std::max(largest, std::abs(wide_radius * std::atan2(r.x(), wide_radius - r.y()) - x[j]));
    }
  }
  page.figure("subdivision_fig09", plot,
              "Figs. 8 and 9: the uneven arc in five parts with k = " + factors +
                  " m from below (Eq. 17); Eq. 18 bounds |k| by " + number(limit, 4) +
                  " m. The nodes' central angles times R are x_j (Fig. 8) within " + number(largest, 1) +
                  " m");
}

void write_pendulum_divisions(Page& page) {
  Plot drawings = drawing("Equal parameter steps on the pendulum (Fig. 18 of [S])");
  for (const auto& [name, arc, outwards] : {std::tuple{"r1: even", PendulumArc::uniform, 0.0},
                                            {"r2: as printed in Section 7", PendulumArc::paper, 0.06},
                                            {"r3: end speeds 1 : 16", PendulumArc::extreme, 0.12}})
    drawings.lines.push_back(
        outline(pendulum_axis(arc), radius, even_parameters(16), outwards, Style::line_and_marks, name));
  page.figure("pendulum_fig18", drawings,
              "Fig. 18: 17 points at equal steps of u; the arcs are moved apart for view");
  const RationalCubic axis = pendulum_axis(PendulumArc::paper);
  const ArcLengthMap measured(axis);
  Plot equal = drawing("Equal division in arc length (Fig. 11 of [S])");
  for (int n = 2; n <= 7; ++n)
    add_division(equal, axis, radius, graded_parameters(measured, n, 0), 0.04 * (n - 2));
  const std::vector<double> u3 = graded_parameters(measured, 3, 0);
  page.figure(
      "pendulum_fig11", equal,
      "Fig. 11: the element of Section 7 in 2 (top) to 7 equal parts, moved apart for view. u_j for n = 3: " +
          number(u3[0], 11) + ", " + number(u3[1], 11) +
          "; the same picture as in [S], whose count of 10⁶ points gives six digits of u_j");
  Plot graded = drawing("Graded division in three (Fig. 20 of [S])");
  for (int i = 0; i < 3; ++i)
    add_division(graded, axis, radius, graded_parameters(measured, 3, 0.1 * (i - 1)), 0.06 * i);
  page.figure(
      "pendulum_fig20", graded,
      "Fig. 20: the same in three parts that grow by k = -0.1 (top), 0 and 0.1 m (Eq. 17); Eq. 18 bounds |k| "
      "by " +
          number(grading_limit(measured.length(), 3), 6) + " m. As in [S]");
}

}  // namespace

void write_subdivision(Page& page) {
  page.heading("Parameter and arc length", 3);
  page.paragraph("Geometry alone.");
  const std::string here = "[parameter and arc length](#parameter-and-arc-length)";
  page.status({"[S] Tables 1-2", here,
               "not to be had: pictures without numbers in the text; replaced by choices", "-"});
  page.status({"[S] Figs. 3-9", here, "reproduced, with an uneven arc of our choice", "in the captions"});
  page.status({"[S] Figs. 11, 18, 20", here, "reproduced", "in the captions"});
  write_even_parameters(page);
  write_parameter_map(page);
  write_proportions(page);
  write_graded_arcs(page);
  write_pendulum_divisions(page);
}

}  // namespace nurbeam::papers
