#include "fem/motion/run/run_step.h"

#include <gtest/gtest.h>

#include "fem/forces/memory.h"
#include "fem/model/build.h"
#include "fem/motion/events/contacts.h"
#include "nurbs/primitives.h"

namespace nurbeam {
namespace {

// A body at rest against a hard stop of a level guide, which something has just begun to pull away: the next
// step begins where it leaves.
class PulledFromItsStop {
 public:
  PulledFromItsStop() : run_{.model = model(), .options = options(), .observer = {}} {
    run_.at = MeshedState::drawn(run_.model);
    run_.at.state.memory = no_memory(run_.at.system->mesh().memory);
    run_.step = *run_.options.step;
    EXPECT_TRUE(start_contacts(run_.at, run_.step));
    EXPECT_TRUE(run_.at.system->mesh().plan.is_closed(0));
    pull_ = -10;
    EXPECT_TRUE(run_.restart());
  }
  Run& run() { return run_; }

 private:
  std::shared_ptr<const BeamModel> model() {
    ModelBuilder builder(2);
    builder.add_guide(ReferenceCurve({line_cubic({0, 0, 0}, {1, 0, 0})}, 2));
    const int body = builder.add_body("body", 2);
    builder.slide(body, 0, 0.5);
    builder.add(
        CustomForce{{Grip::on_body(body)}, [this](double, const Eigen::Matrix3Xd&, const Eigen::Matrix3Xd&) {
                      return CustomForce::Response{Eigen::Vector3d(pull_, 0, 0), {}, {}};
                    }});
    BeamModel model = builder.build();
    model.stops = {{.rider = 0, .place = 0.5}};
    return std::make_shared<const BeamModel>(std::move(model));
  }
  static SimulationOptions options() {
    SimulationOptions options;
    options.end_time = 1;
    options.step = 1e-3;
    return options;
  }

  double pull_ = 10;  // along the guide [N]
  Run run_;
};

constexpr std::size_t most_at_once = 200;  // of a model with one kind of event

TEST(TakeStep, EventsThatFollowEachOtherAtOneMomentEndTheRunWhenTheyAreTooMany) {
  PulledFromItsStop late;
  late.run().events_at_once = 2 * most_at_once;
  EXPECT_FALSE(take_step(late.run(), 1e-3, 0));
  EXPECT_EQ(late.run().at.state.t, 0);
  EXPECT_EQ(late.run().report.status, SimulationStatus::not_converged);
  ASSERT_TRUE(late.run().report.failure);
  EXPECT_EQ(late.run().report.failure->kind, Failure::Kind::endless_events);
  EXPECT_EQ(late.run().report.failure->rider, 0);
  EXPECT_EQ(late.run().report.failure->time, 0);
}

TEST(TakeStep, EventsAtOneMomentAreCountedUntilTimeGoesOn) {
  PulledFromItsStop first;
  auto& run = first.run();
  ASSERT_TRUE(take_step(run, 1e-3, 0));
  EXPECT_EQ(run.at.state.t, 0);
  ASSERT_EQ(run.report.events.size(), 1);
  EXPECT_EQ(run.report.events[0].kind, EventKind::leaves_stop);
  EXPECT_EQ(run.events_at_once, 1);
  ASSERT_TRUE(take_step(run, 1e-3, 0));
  EXPECT_NEAR(run.at.state.t, 1e-3, 1e-15);
  EXPECT_EQ(run.events_at_once, 0);
  EXPECT_NEAR(run.at.state.q[run.at.system->mesh().riders[0].place], 0.5 - 2.5e-6, 1e-9);
}

}  // namespace
}  // namespace nurbeam
