// Several sliding joints on one beam, several beams in one model.

#include <algorithm>
#include <cmath>

#include "tests/convergence/run_model.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

using testing::add_slider;
using testing::even_times;
using testing::line_cubic;
using testing::one_beam;
using testing::round_bar;
using testing::run_model;
using testing::RunRecord;

struct Slider {
  double mass, s, speed;
};

// A beam of 1 m hung at both ends.
BeamModel beam_with_joints(int elements, const std::vector<Slider>& sliders) {
  BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, round_bar(0.01, 7200, 20e6), elements,
                             {{0, false}, {1, false}});
  for (const Slider& slider : sliders) {
    add_slider(model, slider.mass, slider.s);
    model.riders.back().speed = slider.speed;
  }
  return model;
}

// The first body all but catches the second up.
std::vector<Slider> chase() { return {{1, 0.15, 1.4}, {2, 0.3, 1}}; }

double smallest_distance(const RunRecord& run) {
  double distance = 1;
  for (const Snapshot& frame : run.frames)
    distance = std::min(distance, std::abs(*frame.bodies[0].s - *frame.bodies[1].s));
  return distance;
}

double largest_difference(const RunRecord& a, const RunRecord& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.frames.size(); ++i)
    for (std::size_t j = 0; j < a.frames[i].bodies.size(); ++j)
      largest = std::max(
          largest, (a.frames[i].bodies[j].point.position - b.frames[i].bodies[j].point.position).norm());
  return largest;
}

TEST(TwoSliders, ThatShareAnElementConvergeAndKeepTheirEnergy) {
  const std::vector<double> times = even_times(0.25, 25);
  const RunRecord coarse = run_model(beam_with_joints(12, chase()), times, 2e-4);
  const RunRecord middle = run_model(beam_with_joints(24, chase()), times, 2e-4);
  const RunRecord fine = run_model(beam_with_joints(48, chase()), times, 2e-4);
  EXPECT_LT(smallest_distance(fine), 1.0 / 48);
  EXPECT_LT(largest_difference(middle, fine), largest_difference(coarse, fine) / 3);
  EXPECT_LT(largest_difference(middle, fine), 1e-3);
  EXPECT_LT(middle.report.energy_drift, 1e-3 * middle.report.peak_kinetic_energy);
  EXPECT_LT(fine.report.energy_drift, 1e-4 * fine.report.peak_kinetic_energy);
}

TEST(TwoSliders, MoveAsInAMirrorInTheReflectedModel) {
  const std::vector<double> times = even_times(0.25, 10);
  std::vector<Slider> reflected;
  for (const Slider& slider : chase()) reflected.push_back({slider.mass, 1 - slider.s, -slider.speed});
  const RunRecord run = run_model(beam_with_joints(16, chase()), times, 5e-4);
  RunRecord mirror = run_model(beam_with_joints(16, reflected), times, 5e-4);
  EXPECT_GT(run.report.events.size(), 10U);
  for (Snapshot& frame : mirror.frames)
    for (BodyRecord& body : frame.bodies) body.point.position.x() = 1 - body.point.position.x();
  EXPECT_LT(largest_difference(run, mirror), 1e-9);
}

TEST(TwoBeams, MoveEachAsAlone) {
  const std::vector<double> times = even_times(0.3, 10);
  const RunRecord alone = run_model(beam_with_joints(12, {{2, 0.15, 1}}), times, 5e-4);
  BeamModel both = beam_with_joints(12, {{2, 0.15, 1}, {2, 0.15, 1}});
  both.beams.push_back(both.beams[0]);
  both.beams[1].name = "other";
  both.riders[1].beam = 1;
  for (int i : {0, 1}) {
    Support support = std::get<Support>(both.constraints[i]);
    support.beam = 1;
    both.constraints.push_back(support);
  }
  const RunRecord run = run_model(both, times, 5e-4);
  for (std::size_t i = 0; i < times.size(); ++i)
    for (const BodyRecord& body : run.frames[i].bodies)
      EXPECT_LT((body.point.position - alone.body(i)).norm(), 1e-9) << times[i];
}

}  // namespace
}  // namespace nurbeam
