#include <algorithm>
#include <cmath>
#include <ostream>

#include "pipelines/papers/papers.h"
#include "pipelines/papers/papers_places.h"

// The papers' pointwise axial strain against nurbeam's default, the quadratic with its ends and mean.
namespace nurbeam::papers {

namespace {

const std::vector<int> meshes{5, 10, 20, 40};
constexpr int fine_elements = 80;

Method with_ends_and_mean() {
  Method method = ours();
  method.axial_strain = AxialStrain::ends_and_mean;
  return method;
}

/// The same mass and bending stiffness, the radius a fifth.
Example slender(Example example) {
  const auto thick = example.model;
  example.name += ", r/5";
  example.model = [thick](int elements) {
    BeamModel model = thick(elements);
    for (Beam& beam : model.beams) beam.properties.axial_stiffness *= 25;
    return model;
  };
  return example;
}

double largest_jump(const Run& run) {
  double largest = 0;
  for (const RunEvent& event : run.report.events)
    if (event.kind == EventKind::merge || event.kind == EventKind::split)
      largest = std::max(largest, std::abs(event.energy_after - event.energy_before));
  return largest;
}

void write_example(Page& page, const Example& example, const Pace& pace) {
  std::vector<Run> runs(2 * meshes.size() + 1);
  for_each_of(runs.size(), [&](std::size_t i) {
    const bool fine = i == 2 * meshes.size();
    runs[i] = run(example.model(fine ? fine_elements : meshes[i / 2]),
                  fine || i % 2 ? with_ends_and_mean() : ours(), pace, Kept::bodies);
  });
  std::vector<std::vector<std::string>> rows;
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
    const Run &pointwise = runs[2 * mesh], &assumed = runs[2 * mesh + 1];
    rows.push_back({std::to_string(meshes[mesh]), number(rms_distance(pointwise, runs.back()), 2),
                    number(rms_distance(assumed, runs.back()), 2), number(pointwise.report.energy_drift, 2),
                    number(assumed.report.energy_drift, 2), number(largest_jump(pointwise), 2),
                    number(largest_jump(assumed), 2)});
  }
  page.table(statement(example, {ours()}, pace) + "; rms to " + number(pace.end, 2) +
                 " s of the distance of the mass from the run with " + std::to_string(fine_elements) +
                 " elements, ends and mean; energies in J",
             {"elements", "pointwise [m]", "ends and mean [m]", "departure of the energy: pointwise",
              "ends and mean", "largest jump at an event: pointwise", "ends and mean"},
             rows);
}

}  // namespace

void write_axial_strain(Page& page, std::ostream& progress) {
  page.heading("The papers' pointwise axial strain and nurbeam's");
  page.paragraph(
      "Both papers let ε itself carry at every Gauss point, and so does everything else on this page. It "
      "locks as the beam gets slender. By default nurbeam lets the quadratic carry that has the values of ε "
      "at the element's ends and its mean (see [theory](theory.md)). The examples again, and with a fifth of "
      "the radius at the same mass and bending stiffness.");
  for (const Example& example : {falling_beam_example(), slender(falling_beam_example()),
                                 suspended_beam_example(), slender(suspended_beam_example())}) {
    progress << "papers: axial strain, " << example.name << '\n';
    write_example(page, example, {.end = 0.55, .step = 2e-4, .every = 0.01});
  }
}

}  // namespace nurbeam::papers
