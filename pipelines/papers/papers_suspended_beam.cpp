#include <algorithm>
#include <cmath>
#include <ostream>

#include "pipelines/papers/papers.h"
#include "pipelines/papers/papers_events.h"
#include "pipelines/papers/papers_places.h"

// Section 6.2 of the paper: Figure 14.
namespace nurbeam::papers {

namespace {

constexpr int elements = 3, fine_elements = 48;
constexpr Pace pace{.end = 1.0, .step = 2e-4, .every = 0.002};

double length_of(const Snapshot& frame) { return frame.beams[0].length; }

// Central differences of a line.
PlotLine rate_of(PlotLine line) {
  PlotLine rate{line.label, {}, {}, line.style};
  for (std::size_t i = 1; i + 1 < line.x.size(); ++i) {
    rate.x.push_back(line.x[i]);
    rate.y.push_back((line.y[i + 1] - line.y[i - 1]) / (line.x[i + 1] - line.x[i - 1]));
  }
  return rate;
}

void write_shapes(Page& page, const std::vector<Method>& methods, const std::vector<Run>& runs) {
  for (std::size_t i = 0; i < methods.size(); ++i) {
    Plot plot{"Figure 14 (a), " + methods[i].name + ": around the events", "x [m]", "y [m]", {}};
    int shown = 0;
    for (const MeshChangeRecord& change : runs[i].changes) {
      if (change.event.kind == EventKind::split || ++shown > 2) continue;
      const std::string when = number(change.event.time, 3) + " s";
      plot.lines.push_back(shape_of("before, " + when, change.before));
      plot.lines.back().style = PlotLine::Style::dashed;
      plot.lines.push_back(shape_of("after, " + when, change.after));
    }
    if (plot.lines.empty()) continue;
    page.figure("figure-14a-" + std::to_string(i + 1), plot,
                statement(suspended_beam_example(), {methods[i]}, pace));
  }
}

void write_energies(Page& page, const std::vector<Method>& methods, const std::vector<Run>& runs) {
  Plot total{"Figure 14 (d): change of the total energy", "t [s]", "E − E(0) [J]", {}};
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const double start = runs[i].frames[0].energy.total;
    total.lines.push_back(line_of(methods[i].name, runs[i], time_of,
                                  [start](const Snapshot& frame) { return frame.energy.total - start; }));
  }
  page.figure("figure-14d-total", total, statement(suspended_beam_example(), methods, pace));
  Plot parts{"Figure 14 (d): parts of the energy", "t [s]", "E [J]", {}};
  const auto add = [&](std::size_t i, const std::string& name, auto part) {
    parts.lines.push_back(line_of(name + ", " + methods[i].name, runs[i], time_of, part));
    if (i > 0) parts.lines.back().style = PlotLine::Style::dashed;
  };
  for (const std::size_t i : {0U, 2U}) {
    add(
        i, "kinetic", [](const Snapshot& frame) { return frame.energy.kinetic; });
    add(
        i, "gravity", [](const Snapshot& frame) { return frame.energy.gravity; });
    add(i, "elastic", [](const Snapshot& frame) { return frame.energy.axial + frame.energy.bending; });
  }
  page.figure("figure-14d-parts", parts, statement(suspended_beam_example(), {methods[0], methods[2]}, pace));
}

}  // namespace

void write_suspended_beam(Page& page, std::ostream& progress) {
  page.heading("Example 2: a suspended beam with a sliding mass (6.2)");
  progress << "papers: Example 2, 3 elements\n";
  const std::vector<Method> methods{paper_rule(), ale_ancf(), ours()};
  std::vector<Run> runs(methods.size() + 1);
  for_each_of(runs.size(), [&](std::size_t i) {
    const bool fine = i == methods.size();
    runs[i] = run(suspended_beam_example().model(fine ? fine_elements : elements), fine ? ours() : methods[i],
                  pace);
  });
  const std::vector<references::Place> places = references::suspended_beam();
  const std::string how = statement(suspended_beam_example(), methods, pace);

  Plot length{"Figure 14 (b): length of the beam, 3 elements", "t [s]", "length [m]", {}};
  Plot rate{"Figure 14 (c): rate of the length, 3 elements", "t [s]", "d length/dt [m/s]", {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool fine = i == methods.size();
    length.lines.push_back(
        line_of(fine ? "ours, 48 elements" : methods[i].name, runs[i], time_of, length_of));
    if (fine) length.lines.back().style = PlotLine::Style::dashed;
    rate.lines.push_back(rate_of(length.lines.back()));
  }
  length.lines.push_back(marks(
      places, [](const auto& p) { return p.time; }, [](const auto& p) { return p.length; }));
  page.figure("figure-13", start_of("Figure 13: the start, 3 elements", runs[0]), how);
  write_shapes(page, methods, runs);
  page.figure("figure-14b", length, how);
  page.figure("figure-14c", rate, how);
  write_energies(page, methods, runs);

  std::vector<std::vector<std::string>> rows;
  std::vector<EventJumps> jumps;
  std::vector<double> shifts;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    jumps.push_back(jumps_of(runs[i]));
    double shift = 0;
    for (const MeshChangeRecord& change : runs[i].changes) shift = std::max(shift, largest_shift(change));
    shifts.push_back(shift);
    rows.push_back({methods[i].name, std::to_string(jumps[i].events), number(shift),
                    number(jumps[i].largest_length), number(jumps[i].rms_energy),
                    number(runs[i].report.energy_drift), number(largest_distance(runs[i], places))});
  }
  page.table(
      how,
      {"method", "events that remove a node", "largest change of the shape [m]",
       "largest jump of the length [m]", "rms jump of the energy [J]", "largest departure of the energy [J]",
       "largest distance of the mass from the references at " + instants(places) + " [m]"},
      rows);
  const bool smaller = shifts[0] < shifts[1] && jumps[0].largest_length < jumps[1].largest_length &&
                       jumps[0].rms_energy < jumps[1].rms_energy;
  page.status({"[D] Figs. 13-14", "[Example 2](#example-2-a-suspended-beam-with-a-sliding-mass-62)",
               smaller ? "reproduced" : "reproduced in part",
               number(largest_distance(runs.back(), places), 2) +
                   " m with 48 elements from the references at " + instants(places)});
  const auto compared = [](double a, double b) { return a < b ? "smaller" : "not smaller"; };
  page.paragraph(
      std::string(
          "The paper says that shape, length and energies change less at an event with its weights than "
          "with ALE-ANCF; here the largest displacement of a material point is ") +
      compared(shifts[0], shifts[1]) + ", the largest jump of the length " +
      compared(jumps[0].largest_length, jumps[1].largest_length) + " and the rms jump of the energy " +
      compared(jumps[0].rms_energy, jumps[1].rms_energy) +
      " with the paper's rule than with ALE-ANCF. With ours, which meets its events later and keeps the "
      "energy, the "
      "displacement is " +
      compared(shifts[2], shifts[0]) +
      " than with the paper's rule. Both start from the same model: until the first event "
      "their "
      "curves coincide, as the paper says. With 48 elements the mass is within " +
      number(largest_distance(runs.back(), places), 2) + " m of the references at " + instants(places) + ".");
}

}  // namespace nurbeam::papers
