// The work of loads and prescribed motions against the energy that it brings: what is left falls with the
// square of the step, and is none where the force is dead and stays at its place.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "fem/motion/run/simulation.h"
#include "pipelines/verification/models.h"

namespace nurbeam {
namespace {

using namespace verification;

BeamModel arc(int dimension = 2) {
  return one_beam(arc_cubics({0, 1, 0}, 1, -std::numbers::pi / 2, 0, 1), dimension,
                  round_bar(0.02, 2000, 2e7), 6, {{0, true}});
}

/// Largest departure of the total energy over the work put in.
double departure(const BeamModel& model, double step) {
  SimulationOptions options;
  options.end_time = 0.2;
  options.step = step;
  options.integrator = GeneralizedAlpha{.rho_infinity = 1};
  for (int i = 0; i <= 20; ++i) options.output_times.push_back(0.01 * i);
  double start = 0, departed = 0, input = 0;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& frame) {
    if (frame.time == 0) start = frame.energy.total;
    departed = std::max(departed, std::abs(frame.energy.total - start));
    input = std::max(input, std::abs(frame.energy.input));
  };
  EXPECT_EQ(simulate(model, {}, options, observer).status, SimulationStatus::done);
  EXPECT_GT(input, 0.1);
  return departed / input;
}

struct Driven {
  const char* name;
  std::function<BeamModel()> model;
};

class InputWork : public ::testing::TestWithParam<Driven> {};

TEST_P(InputWork, KeepsTheBalanceToTheOrderOfTheStep) {
  const BeamModel model = GetParam().model();
  // Over two halvings: departures of a millionth are irregular from one to the next.
  const double coarse = departure(model, 4e-4), fine = departure(model, 1e-4);
  EXPECT_LT(fine, 3e-4);
  EXPECT_GT(coarse / fine, 9) << coarse << ", " << fine;
}

const TimeTable ramp{{0, 0}, {0.1, 1}, {0.2, 0.5}};

INSTANTIATE_TEST_SUITE_P(
    Each, InputWork,
    ::testing::Values(
        Driven{"DeadForce",
               [] {
                 BeamModel model = arc();
                 add_force(model, {3, 20, 0}, 10);
                 return model;
               }},
        Driven{"RampedFollowerForceInSpace",
               [] {
                 BeamModel model = arc(3);
                 LoadAtPlace load = load_at(model, {0, -20, 5}, 10);
                 load.follower = true;
                 load.time = ramp;
                 model.forces.push_back(PointLoad{load});
                 return model;
               }},
        Driven{"Moment",
               [] {
                 BeamModel model = arc();
                 LoadAtPlace load = load_at(model, {0, 0, 2}, 10);
                 load.time = ramp;
                 model.forces.push_back(Moment{load});
                 return model;
               }},
        Driven{"LineLoadBesideASlider",
               [] {
                 BeamModel model = arc();
                 add_slider(model, 0.5, 0.4);
                 model.forces.push_back(LineLoad{0, {10, 30, 0}, ramp});
                 return model;
               }},
        Driven{"MovingForce",
               [] {
                 BeamModel model = arc();
                 add_force(model, {0, -30, 0}, 0, 6);
                 return model;
               }},
        Driven{"SpringToAPoint",
               [] {
                 BeamModel model = arc();
                 CustomForce spring;
                 spring.points = {Grip::on_beam(0, model.beams[0].curve.length())};
                 spring.law = [](double, const Eigen::Matrix3Xd& r, const Eigen::Matrix3Xd&) {
                   return CustomForce::Response{200 * (Eigen::Vector3d(2, 2, 0) - r.col(0)), {}, {}};
                 };
                 model.forces.push_back(spring);
                 return model;
               }},
        Driven{"DrivenSlider",
               [] {
                 BeamModel model = arc();
                 add_slider(model, 2, 0.3);
                 model.riders[0].motion = TimeTable{{0, 0.3}, {0.2, 0.7}};
                 return model;
               }}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace nurbeam
