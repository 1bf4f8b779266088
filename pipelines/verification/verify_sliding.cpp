// The examples of Ding & Ouyang 2022 against reference runs of two independent programs.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipelines/verification/references.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_examples.h"
#include "pipelines/verification/verify_run.h"

namespace nurbeam {

namespace {

using namespace verification;

using references::Place;

/// A sliding example: its references with their errors, and the meshes on which it converges to them.
struct Example {
  BeamModel (*model)(int elements);
  std::vector<Place> places;
  std::string source;
  double tolerance, s_tolerance;  // [m]
  std::vector<int> meshes;        // of the convergence table
  int fine;
  double step;
  double rho_infinity;
};

RunRecord run_example(const Example& example, int elements, double end = 0) {
  std::vector<double> times;
  for (const Place& place : example.places) times.push_back(place.time);
  if (end > times.back()) times.push_back(end);
  const BeamModel model = example.model(elements);
  return run_model(model, times, example.step, example.rho_infinity, {{0, model.beams[0].curve.length()}});
}

double largest_error(const Example& example, const RunRecord& run) {
  double largest = 0;
  for (std::size_t i = 0; i < example.places.size(); ++i)
    largest = std::max(
        largest, std::hypot(run.body(i).x() - example.places[i].x, run.body(i).y() - example.places[i].y));
  return largest;
}

std::string at_time(double t) { return " [m], t = " + std::to_string(t).substr(0, 3) + " s"; }

void add_places(VerifyResult& result, const Example& example, const RunRecord& fine) {
  const std::string mesh = ", " + std::to_string(example.fine) + " elements";
  for (std::size_t i = 0; i < example.places.size(); ++i) {
    const Place& place = example.places[i];
    const std::string when = at_time(place.time) + mesh;
    result.add("body x" + when, place.x, example.source, fine.body(i).x(), example.tolerance);
    result.add("body y" + when, place.y, example.source, fine.body(i).y(), example.tolerance);
    result.add("s" + when, place.s, example.source, fine.place(i), example.s_tolerance);
  }
}

void add_convergence(VerifyResult& result, const Example& example, const RunRecord& fine) {
  ConvergenceTable table{"the body [m], largest in x and y", "elements", {}};
  for (const int elements : example.meshes)
    table.rows.emplace_back(
        elements, largest_error(example, elements == example.fine ? fine : run_example(example, elements)));
  result.add(std::move(table), 2, 0, "at least second order");
}

double leaving_time(const RunRecord& run) {
  for (const RunEvent& event : run.report.events)
    if (event.kind == EventKind::left_beam) return event.time;
  return std::nan("");
}

VerifyResult example_1() {
  const Example example{falling_beam,
                        references::falling_beam(),
                        "two reference runs, 1e-5 m",
                        1e-5,
                        1e-5,
                        {10, 20, 40},
                        60,
                        1e-4,
                        0.9};
  VerifyResult result;
  const RunRecord fine = run_example(example, example.fine, 0.75);
  add_places(result, example, fine);
  // The end whips: what is left there on this mesh is not below the references' error. It falls with order 4.
  const RunRecord medium = run_example(example, 40, 0.75);
  const auto own_error = [](double at_40, double at_60) {
    return std::abs(at_60 - at_40) / (std::pow(60.0 / 40, 4) - 1);
  };
  const std::string with_own_error = ", and this mesh's own error, from 40 elements by order 4";
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string when = at_time(example.places[i].time) + ", 60 elements";
    result.add("end y" + when, example.places[i].end_y, example.source + with_own_error, fine.probe(i).y(),
               1e-5 + own_error(medium.probe(i).y(), fine.probe(i).y()));
    result.add("length" + when, example.places[i].length, example.source, fine.frames[i].beams[0].length,
               1e-5);
  }
  const double leaves = leaving_time(fine);
  const std::string source = "two reference runs, 5e-5 s";
  result.add("time of leaving [s]", references::falling_beam_leaves, source + with_own_error, leaves,
             5e-5 + own_error(leaving_time(medium), leaves));
  // Back along the free flight from the last frame.
  const Snapshot& last = fine.frames.back();
  const double flight = last.time - leaves;
  Eigen::Vector3d r = last.bodies[0].point.position, v = last.bodies[0].point.velocity;
  v.y() += 9.81 * flight;
  r -= flight * (v - Eigen::Vector3d(0, 9.81 * flight / 2, 0));
  result.add("x on leaving [m]", -0.4952, source, r.x(), 2e-4);
  result.add("y on leaving [m]", -0.7177, source, r.y(), 2e-4);
  result.add("v_x on leaving [m/s]", -2.46, source, v.x(), 1e-2);
  result.add("v_y on leaving [m/s]", -0.86, source, v.y(), 1e-2);
  add_convergence(result, example, fine);
  return result;
}

VerifyResult example_2() {
  const Example example{suspended_beam,
                        references::suspended_beam(),
                        "two reference runs, 2e-5 m (s 1.5e-4 m)",
                        2e-5,
                        1.5e-4,
                        {12, 24, 48},
                        48,
                        2e-4,
                        0.9};
  VerifyResult result;
  const RunRecord fine = run_example(example, example.fine);
  add_places(result, example, fine);
  for (std::size_t i = 0; i < 3; ++i)
    result.add("length" + at_time(example.places[i].time) + ", 48 elements", example.places[i].length,
               example.source, fine.frames[i].beams[0].length, 2e-5);
  add_convergence(result, example, fine);
  return result;
}

void add_start_energy(VerifyResult& result, const Example& example, double energy) {
  const BeamModel model = example.model(example.fine);
  const RunRecord start = run_model(model, {0, 1e-6}, 1e-6);
  result.add("total energy at the start [J]", energy, "two reference runs", start.frames[0].energy.total,
             1e-5);
}

VerifyResult example_3_as_drawn() {
  const Example example{[](int elements) { return semicircle(elements, false); },
                        references::semicircle(false),
                        "two reference runs, 2e-5 m",
                        2e-5,
                        2e-5,
                        {24, 48, 72},
                        72,
                        2e-4,
                        0.9};
  VerifyResult result;
  add_start_energy(result, example, -713.13245);
  const RunRecord fine = run_example(example, example.fine);
  add_places(result, example, fine);
  add_convergence(result, example, fine);
  return result;
}

VerifyResult example_3_straight() {
  Example example{[](int elements) { return semicircle(elements, true); },
                  {references::semicircle(true)[0]},
                  "two reference runs, 1e-4 m",
                  1e-4,
                  1e-4,
                  {24, 48},
                  144,
                  2e-4,
                  0.9};
  const Place later = references::semicircle(true)[1];
  VerifyResult result;
  add_start_energy(result, example, -693.39324);
  const RunRecord fine = run_example(example, example.fine, later.time);
  add_places(result, example, fine);

  // The end moments let go at the start leave energy in every mode the mesh has, and its waves press on the
  // body: after a bounce at the far side the meshes scatter by more than the references differ.
  const auto place = [](const RunRecord& run) {
    return Eigen::Vector3d(run.body(1).x(), run.body(1).y(), run.place(1));
  };
  Eigen::Vector3d low = place(fine), high = low;
  for (const int elements : {108, 120}) {
    const Eigen::Vector3d other = place(run_example(example, elements, later.time));
    low = low.cwiseMin(other);
    high = high.cwiseMax(other);
  }
  const std::string source = "two reference runs, 1e-4 m, and half the spread of 108, 120, 144 elements";
  const Eigen::Vector3d computed = place(fine), reference(later.x, later.y, later.s);
  const char* names[] = {"body x", "body y", "s"};
  for (int i = 0; i < 3; ++i)
    result.add(names[i] + at_time(later.time) + ", 144 elements", reference[i], source, computed[i],
               1e-4 + (high[i] - low[i]) / 2);
  add_convergence(result, example, fine);
  return result;
}

}  // namespace

std::vector<VerifyProblem> sliding_problems() {
  return {
      {"example-1", "spatial, Green, straight", example_1},
      {"example-2", "spatial, Green, straight", example_2},
      {"example-3-as-drawn", "spatial, Green, as drawn", example_3_as_drawn},
      {"example-3-straight", "spatial, Green, straight", example_3_straight},
  };
}

}  // namespace nurbeam
