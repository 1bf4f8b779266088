#include <ostream>

#include "pipelines/papers/papers.h"
#include "pipelines/papers/papers_places.h"

// Section 5 of the paper: the slope of the beam jumps at the sliding joint. Example 2 as a cable.
namespace nurbeam::papers {

namespace {

const std::vector<int> meshes{5, 10, 20, 40, 80};
const std::vector<double> steps{4e-4, 2e-4, 1e-4};  // [s]
constexpr double pretension = 0.02;                 // over EA

Example cable_example(bool kinked) {
  Example example = suspended_beam_example();
  example.name = "Example 2 as a cable";
  example.model = [kinked](int elements) {
    BeamModel model = suspended_beam_example().model(elements);
    model.beams[0].properties.bending_stiffness = 0;
    model.beams[0].properties.free_strain.constant = -pretension;
    model.riders[0].continuous_slope = !kinked;
    return model;
  };
  return example;
}

// nurbeam's axial strain: a free strain needs it.
Method with_ends_and_mean() {
  Method method = ours();
  method.axial_strain = AxialStrain::ends_and_mean;
  return method;
}

Run cable_run(bool kinked, int elements, double step) {
  return run(cable_example(kinked).model(elements), with_ends_and_mean(),
             {.end = 1, .step = step, .every = 0.005});
}

std::string distance_of(const Run& run, const std::vector<references::Place>& places) {
  return run.complete() ? number(largest_distance(run, places), 2) : "ended early";
}

void write_path(Page& page, const Run& kinked, const std::vector<references::Place>& places) {
  Plot shapes{"Example 2 as a cable: shapes, 20 elements", "x [m]", "y [m]", {}};
  for (const references::Place& place : places)
    for (const Snapshot& frame : kinked.frames)
      if (std::abs(frame.time - place.time) < 1e-9)
        shapes.lines.push_back(shape_of(number(place.time) + " s", frame.beams[0]));
  shapes.lines.push_back(marks(
      places, [](const auto& p) { return p.x; }, [](const auto& p) { return p.y; }));
  page.figure("example-2-cable", shapes,
              "No bending stiffness, drawn at 0.02 EA, discontinuous slope at the mass; step 0.0002 s; the "
              "marks are the reference's positions of the mass");
}

}  // namespace

void write_cable(Page& page, std::ostream& progress) {
  page.heading("Example 2 as a cable: a discontinuous slope (Section 5)", 3);
  progress << "papers: Example 2 as a cable\n";
  page.paragraph(
      "The paper's sliding joint has slope vectors of its own on both sides (its Fig. 6), and shows no example "
      "that needs them. Here is one: Example 2 without bending stiffness, pretensioned by 0.02 EA, so that "
      "the mass hangs at a slope discontinuity. The reference is a program of its own, linear elements that move with the mass "
      "on both sides, to 1e-6 m. Where slopes are continuous, nothing resists the sharp bend that an element then makes "
      "under the mass: such runs end early or are wrong.");
  const std::vector<references::Place> places = references::suspended_cable();
  const std::size_t ways = steps.size() + 1;  // the last one: continuous slopes with the second step
  std::vector<Run> runs(meshes.size() * ways);
  for_each_of(runs.size(), [&](std::size_t i) {
    const bool kinked = i % ways < steps.size();
    runs[i] = cable_run(kinked, meshes[i / ways], kinked ? steps[i % ways] : steps[1]);
  });
  std::vector<std::vector<std::string>> rows;
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
    std::vector<std::string> row{std::to_string(meshes[mesh])};
    for (std::size_t way = 0; way < ways; ++way) row.push_back(distance_of(runs[mesh * ways + way], places));
    rows.push_back(row);
  }
  std::vector<std::string> header{"elements"};
  for (const double step : steps) header.push_back("discontinuous, step " + number(step) + " s [m]");
  header.push_back("continuous, step " + number(steps[1]) + " s [m]");
  page.table("Largest distance of the mass from the reference at " + instants(places) +
                 "; ends and mean; thresholds 0.1/1.15 (ours); ρ∞ = 0.9",
             header, rows);
  page.status({"[D] Eqs. 39-41: the sliding joint",
               "[as a cable](#example-2-as-a-cable-a-discontinuous-slope-section-5)",
               "reproduced, with slopes of its own on both sides",
               number(largest_distance(runs[(meshes.size() - 1) * ways + steps.size() - 1], places), 2) +
                   " m with 80 elements from the reference"});
  write_path(page, runs[2 * ways + 1], places);
}

}  // namespace nurbeam::papers
