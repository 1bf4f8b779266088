#include <algorithm>
#include <cmath>

#include "pipelines/papers/papers.h"
#include "pipelines/papers/papers_run.h"
#include "pipelines/papers/printed_pendulum.h"
#include "pipelines/verification/references.h"

// Eqs. 20-24 of [S] to the letter: the curvature |r_xx| of its Eq. 23 beside the spatial one.
namespace nurbeam::papers {

namespace {

constexpr PrintedCurvature second = PrintedCurvature::second_derivative, spatial = PrintedCurvature::spatial;
constexpr double step = 5e-4;  // [s]
const std::vector<int> meshes{2, 4, 6, 8, 16};

// Stable for RK4 up to 16 elements.
double step_of(int elements) { return elements > 8 ? 2e-4 : step; }

std::string name_of(PrintedCurvature curvature) { return curvature == spatial ? "spatial" : "Eq. 23"; }

std::string at(const PrintedMotion& motion, std::size_t frame) {
  return frame < motion.AB.size() ? number(motion.AB[frame], 4) : "-";
}

void write_steps(Page& page, const PendulumMotion& fine) {
  struct Way {
    PrintedCurvature curvature;
    double step;
    int panels;
  };
  std::vector<std::vector<std::string>> rows;
  for (const Way& way : {Way{second, 1e-3, 1},
                         {second, 5e-4, 1},
                         {second, 2.5e-4, 1},
                         {second, 1.25e-4, 1},
                         {second, 5e-4, 2},
                         {second, 2.5e-4, 2},
                         {spatial, 1e-3, 1},
                         {spatial, 5e-4, 1},
                         {spatial, 2.5e-4, 2}}) {
    const PrintedMotion motion =
        printed_pendulum_motion({.curvature = way.curvature, .step = way.step, .panels = way.panels});
    rows.push_back({name_of(way.curvature), std::to_string(5 * way.panels), number(way.step * 1e3),
                    at(motion, 40), at(motion, 100),
                    motion.complete() ? number(motion.energy_departure, 2) : "unstable"});
  }
  const PendulumMotion own = pendulum_motion({.elements = 8}, ExplicitRungeKutta{}, step);
  rows.push_back({"spatial, with the metric", "5", number(step * 1e3), number(own.AB[40], 4),
                  number(own.AB[100], 4), number(own.report.energy_drift, 2)});
  rows.push_back(
      {"the same, 64 elements", "5", "extrapolated", number(fine.AB[40], 4), number(fine.AB[100], 4), "-"});
  page.table("r1 in 8 equal parts, Eqs. 20-24, RK4; energies against the start's, at every step",
             {"curvature", "Gauss points in an element", "step [ms]", "\\|AB\\| at 0.4 s [m]", "at 1 s [m]",
              "largest departure of the energy [J]"},
             rows);
}

struct Row {
  std::string name;
  PendulumArc arc;
  bool ancf;
};

// The differences of one row from the fine run, mesh by mesh.
std::vector<PrintedMotion> motions_of(const Row& row, PrintedCurvature curvature) {
  std::vector<PrintedMotion> motions(meshes.size());
  for_each_of(motions.size(), [&](std::size_t i) {
    const int n = meshes[i];
    motions[i] = printed_pendulum_motion(
        {.arc = row.arc, .elements = n, .curvature = curvature, .step = step_of(n), .ancf = row.ancf});
  });
  return motions;
}

std::string cell(const PrintedMotion& motion, const std::vector<double>& AB) {
  if (!motion.complete()) return "unstable";
  return number(largest_difference_in_AB(motion.AB, AB), 2);
}

// What 6 elements are from 8, and 8 from the fine run, for r1 with each curvature.
struct Findings {
  double six_to_eight[2], eight_to_fine[2];
};

Findings write_meshes(Page& page, const PendulumMotion& fine) {
  Findings found{};
  std::vector<std::vector<std::string>> rows;
  for (const auto curvature : {second, spatial})
    for (const Row& row : {Row{"r1", PendulumArc::uniform, false},
                           {"r1, ANCF", PendulumArc::uniform, true},
                           {"r2", PendulumArc::paper, false},
                           {"r3", PendulumArc::extreme, false}}) {
      const std::vector<PrintedMotion> motions = motions_of(row, curvature);
      std::vector<std::string> cells{name_of(curvature), row.name};
      for (const PrintedMotion& motion : motions) cells.push_back(cell(motion, fine.AB));
      rows.push_back(cells);
      if (row.name != "r1") continue;
      found.six_to_eight[curvature == spatial] = largest_difference_in_AB(motions[2].AB, motions[3].AB);
      found.eight_to_fine[curvature == spatial] = largest_difference_in_AB(motions[3].AB, fine.AB);
    }
  std::vector<std::string> header{"curvature", "element"};
  for (const int n : meshes) header.push_back(std::to_string(n));
  page.table(
      "Largest difference in |AB| over 1 s from the fine run with the metric [m], by the number of equal "
      "parts; five Gauss points, RK4 with 0.5 ms, with 16 parts 0.2 ms",
      header, rows);
  return found;
}

void write_limits(Page& page, const PendulumMotion& fine) {
  for (const auto& [figure, curve] : {std::pair{"15", 0}, {"21", 1}}) {
    Plot plot{
        curve == 0 ? "r1 by Eq. 23 (Fig. 15 of [S])" : "r2 in three elements by Eq. 23 (Fig. 21 of [S])",
        "t [s]",
        "|AB| [m]",
        {}};
    plot.lines.push_back({"64 elements, metric", fine.t, fine.AB, PlotLine::Style::dashed});
    const auto add = [&](const std::string& label, const PrintedPendulum& pendulum) {
      const PrintedMotion motion = printed_pendulum_motion(pendulum);
      plot.lines.push_back({label, motion.t, motion.AB});
    };
    if (curve == 0)
      for (const int n : {1, 2, 4, 6, 8})
        add(std::to_string(n) + (n == 1 ? " element" : " elements"), {.elements = n});
    else
      for (const double k : {-0.1, 0.0, 0.1})
        add("k = " + number(k) + " m", {.arc = PendulumArc::paper, .elements = 3, .grading = k});
    page.figure(std::string("pendulum_fig") + figure + "_printed", plot,
                std::string("Fig. ") + figure + " by Eqs. 20-24 as printed: RK4, step 0.5 ms");
  }
}

// Largest differences from the fine run over the position of the division of two elements.
struct Range {
  double least = HUGE_VAL, largest = 0;
  int lost = 0;
};
Range range_over_places(PendulumArc arc, PrintedCurvature curvature, const PendulumMotion& fine) {
  Range range;
  for (const double k : {-0.4, -0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4}) {
    const PrintedMotion motion =
        printed_pendulum_motion({.arc = arc, .elements = 2, .grading = k, .curvature = curvature});
    if (!motion.complete()) {
      ++range.lost;
      continue;
    }
    const double off = largest_difference_in_AB(motion.AB, fine.AB);
    range = {std::min(range.least, off), std::max(range.largest, off), range.lost};
  }
  return range;
}

void write_places(Page& page, const PendulumMotion& fine) {
  std::vector<std::vector<std::string>> rows;
  for (const auto curvature : {second, spatial})
    for (const auto& [name, arc] :
         {std::pair{"r1", PendulumArc::uniform}, {"r2", PendulumArc::paper}, {"r3", PendulumArc::extreme}}) {
      const Range range = range_over_places(arc, curvature, fine);
      rows.push_back({name_of(curvature), name, number(range.least, 2), number(range.largest, 2),
                      std::to_string(range.lost)});
    }
  page.table(
      "Two elements, nine positions of their division, k from -0.4 to 0.4 m (Fig. 19 of [S]): largest difference "
      "in |AB| over 1 s from the fine run with the metric, the minimum and the maximum of the nine; RK4, 0.5 ms",
      {"curvature", "element", "minimum [m]", "maximum [m]", "unstable runs"}, rows);
}

}  // namespace

void write_printed_pendulum(Page& page, const PendulumMotion& fine) {
  page.heading("Eq. 23 as printed", 3);
  page.paragraph(
      "Eq. 23 of [S] is κ = |r_xx|: no sign, and a curvature only where |r_x| stays 1. Here are its Eqs. 20-24 "
      "to the letter, without the metric, and the same with the spatial curvature, which all else on this page "
      "takes. As the arc straightens and bends the other way, |r_xx| falls to zero and grows again. The "
      "energy has a corner there and the force jumps, so that Gauss points and steps decide what the motion "
      "is.");
  write_steps(page, fine);
  const Findings found = write_meshes(page, fine);
  write_places(page, fine);
  write_limits(page, fine);
  const auto can = [](bool yes) { return yes ? "can" : "cannot"; };
  constexpr double seen = 0.02;  // what a reader sees in the figures [m]
  page.status({"[S] Eqs. 20-24", "[Eq. 23 as printed](#eq-23-as-printed)",
               "corrected: a metric, and a curvature with a sign",
               number(found.eight_to_fine[0], 2) + " m in \\|AB\\| with Eq. 23, " +
                   number(found.eight_to_fine[1], 2) + " m with the spatial curvature, both without metric"});
  page.paragraph(
      "What of [S] comes of which curvature, taking 0.02 m for what its figures let one see. Fig. 15, six "
      "elements converged: 6 and 8 elements of r1 differ by " +
      number(found.six_to_eight[0], 2) + " m with Eq. 23, so it " + can(found.six_to_eight[0] < seen) +
      " come of Eq. 23; by " + number(found.six_to_eight[1], 2) + " m with the spatial curvature, so it " +
      can(found.six_to_eight[1] < seen) +
      " come of that. Fig. 22, r1 agrees with other elements: 8 elements of r1 are " +
      number(found.eight_to_fine[0], 2) + " m off with Eq. 23 (" + can(found.eight_to_fine[0] < seen) +
      "), " + number(found.eight_to_fine[1], 2) + " m with the spatial curvature (" +
      can(found.eight_to_fine[1] < seen) +
      "). Figs. 19 and 21, results that depend on parameter and position of the division: they do with either "
      "curvature, for the metric is missing in both. So nothing in the four figures needs Eq. 23, and " +
      std::to_string((found.six_to_eight[0] >= seen) + (found.eight_to_fine[0] >= seen)) +
      " of the first two speaks against its having been used as printed. Where a run is unstable, RK4's step is too "
      "long for parts that are short in the label, those of r3.");
}

}  // namespace nurbeam::papers
