#include <ostream>

#include "pipelines/papers/papers.h"
#include "pipelines/papers/papers_places.h"

// Section 6.3 of the paper: Figure 16.
namespace nurbeam::papers {

namespace {

const std::vector<int> counts{8, 16, 32};
constexpr Pace pace{.end = 1.5, .step = 4e-4, .every = 0.005};

void write_state(Page& page, bool straight) {
  const Example example = semicircle_example(straight);
  const std::string suffix = straight ? "-straight" : "-as-drawn";
  std::vector<Run> runs(counts.size() + 1);
  for_each_of(runs.size(), [&](std::size_t i) {
    const bool paper = i == counts.size();
    runs[i] = run(example.model(paper ? counts.back() : counts[i]), paper ? paper_rule() : ours(), pace);
  });
  const std::vector<references::Place> places = references::semicircle(straight);
  const std::string how = statement(example, {ours(), paper_rule()}, pace);
  page.heading(example.name, 3);

  Plot shapes{"Figure 16 (a): configurations, 16 elements, ours", "x [m]", "y [m]", {}};
  shapes.equal_axes = true;
  for (const double time : {0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5})
    for (const Snapshot& frame : runs[1].frames)
      if (std::abs(frame.time - time) < 1e-9)
        shapes.lines.push_back(shape_of(number(time, 3) + " s", frame.beams[0]));
  page.figure("figure-16a" + suffix, shapes, statement(example, {ours()}, pace));

  Plot length{"Figure 16 (b): length of the beam", "t [s]", "length [m]", {}};
  Plot path{"Figure 16 (c): the sliding mass", "x [m]", "y [m]", {}};
  Plot energy{"Figure 16 (d): energies, 32 elements, ours", "t [s]", "E [J]", {}};
  path.equal_axes = true;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string label = i == counts.size() ? std::to_string(counts.back()) + ", paper's rule"
                                                 : std::to_string(counts[i]) + ", ours";
    length.lines.push_back(
        line_of(label, runs[i], time_of, [](const Snapshot& frame) { return frame.beams[0].length; }));
    path.lines.push_back(line_of(label, runs[i], body_x, body_y));
  }
  path.lines.push_back(marks(
      places, [](const auto& p) { return p.x; }, [](const auto& p) { return p.y; }));
  const Run& fine = runs[counts.size() - 1];
  energy.lines.push_back(line_of(
      "kinetic", fine, time_of, [](const Snapshot& frame) { return frame.energy.kinetic; }));
  energy.lines.push_back(line_of(
      "elastic", fine, time_of,
      [](const Snapshot& frame) { return frame.energy.axial + frame.energy.bending; }));
  energy.lines.push_back(line_of("gravity", fine, time_of, [&](const Snapshot& frame) {
    return frame.energy.gravity - fine.frames[0].energy.gravity;
  }));
  energy.lines.back().label = "gravity, from its start";
  energy.lines.push_back(line_of("total, from its start", fine, time_of, [&](const Snapshot& frame) {
    return frame.energy.total - fine.frames[0].energy.total;
  }));
  page.figure("figure-16b" + suffix, length, how);
  page.figure("figure-16c" + suffix, path, how);
  page.figure("figure-16d" + suffix, energy, statement(example, {ours()}, pace));

  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool paper = i == counts.size();
    rows.push_back({paper ? "paper's rule" : "ours", std::to_string(paper ? counts.back() : counts[i]),
                    number(runs[i].frames[0].energy.total, 8), number(straight ? -693.39324 : -713.13245, 8),
                    number(largest_distance(runs[i], places)), number(runs[i].report.energy_drift)});
  }
  page.table(how,
             {"method", "elements", "energy at the start [J]", "reference [J]",
              "largest distance of the mass from the references [m]", "largest departure of the energy [J]"},
             rows);
}

}  // namespace

void write_semicircle(Page& page, std::ostream& progress) {
  page.heading("Example 3: a suspended semicircle with a sliding mass (6.3)");
  page.paragraph(
      "Eq. 19 of the paper takes the curvature itself for the strain, so that its semicircle is a straight "
      "beam "
      "bent to the drawing by end moments that are gone at the start; `straight` is that reading. `as-drawn` "
      "is "
      "what the text suggests, a beam that is stress-free in its drawn shape. The paper does not say with "
      "how "
      "many elements it computes.");
  for (const bool straight : {true, false}) {
    progress << "papers: " << semicircle_example(straight).name << '\n';
    write_state(page, straight);
  }
  page.paragraph(
      "As the paper says, the drawn shape is exact at the start, so that the energy there does not depend on "
      "the number of elements, and the results converge; the distances in the tables fall from row to row of "
      "ours. Its figure has no numbers, and cannot tell which of the two stress-free states it has.");
}

}  // namespace nurbeam::papers
