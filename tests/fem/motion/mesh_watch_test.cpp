#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "fem/motion/remesh/mesh_rules.h"
#include "fem/system/initial_state.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

using testing::line_cubic;

// Two lines of a metre in one, of 20 elements, with a break that stays in the middle.
BeamModel line_with_bodies(const std::vector<double>& places, bool continuous_slope = true) {
  BeamModel model =
      testing::one_beam({line_cubic({0, 0, 0}, {0.5, 0, 0}), line_cubic({0.5, 0, 0}, {1, 0, 0})}, 2,
                        {300, 2, 0.7, 0, {}}, 20, {});
  for (const double s : places) testing::add_slider(model, 0.8, s).continuous_slope = continuous_slope;
  return model;
}

BeamModel ring_with_body() {
  ModelBuilder builder(2);
  builder.add_beam(
      ReferenceCurve(testing::arc_cubics({0, 0, 0}, 0.2, 0, 2 * M_PI, 4), 2, Metric::arc_length, true),
      BeamProperties{300, 2, 0.7}, {20});
  BeamModel model = builder.build();
  testing::add_slider(model, 0.8, 0.3);
  return model;
}

// A motion of bodies along drawn beams, back and forth by steps of so many metres at most.
class Walk {
 public:
  Walk(BeamModel model, double longest, unsigned seed)
      : model_(std::make_shared<const BeamModel>(std::move(model))),
        random_(seed),
        step_(-0.7 * longest, longest) {
    take(initial_plan(*model_));
  }

  /// One step, and the changes that are due. Whether the watch says that there is none.
  bool go() {
    for (std::size_t j = 0; j < model_->riders.size(); ++j) move(static_cast<int>(j), step_(random_));
    const bool quiet = watch_.is_quiet(system_, state_);
    if (quiet) return expect_nothing(), true;
    while (true) {
      NextPlan next = next_plan(*system_, state_, LengthControl{});
      watch_.look(system_, next);
      if (next.change == MeshChange::none) return false;
      EXPECT_FALSE(watch_.is_quiet(system_, state_));
      take(std::move(next.plan));
      ++changes;
    }
  }

  int changes = 0;

 private:
  void take(MeshPlan plan) {
    system_ = std::make_shared<const BeamSystem>(model_, std::move(plan));
    state_ = drawn_state(*system_);
    for (std::size_t j = 0; j < model_->riders.size(); ++j) move(static_cast<int>(j), 0);
  }
  // Along a beam that is no ring to one of its ends at most.
  void move(int j, double by) {
    const int place = system_->mesh().riders[j].place;
    const Beam& beam = model_->beam_of(model_->riders[j]);
    const double end = beam.is_ring() ? 1e9 : beam.curve.length();
    state_.q[place] = std::clamp(state_.q[place] + by, beam.is_ring() ? -1e9 : 0, end);
    state_.v[place] = by;
  }
  // Whichever way the bodies go on.
  void expect_nothing() const {
    State state = state_;
    for (const double sign : {1, -1}) {
      for (const MeshRider& joint : system_->mesh().riders) state.v[joint.place] = sign;
      EXPECT_EQ(next_plan(*system_, state, LengthControl{}).change, MeshChange::none)
          << state.q[system_->mesh().riders[0].place];
    }
  }

  std::shared_ptr<const BeamModel> model_;
  std::mt19937 random_;
  std::uniform_real_distribution<double> step_;
  std::shared_ptr<const BeamSystem> system_;
  State state_;
  MeshWatch watch_;
};

TEST(MeshWatch, IsQuietOnlyWhereTheNextPlanIsNoneAndThenMostly) {
  for (const double longest : {3e-5, 3e-4, 7e-3})
    for (const bool continuous_slope : {true, false})
      for (BeamModel& model : std::vector{line_with_bodies({0.12}, continuous_slope), ring_with_body(),
                                          line_with_bodies({0.12, 0.6}, continuous_slope)}) {
        Walk walk(std::move(model), longest, 7);
        const int steps = static_cast<int>(3 / longest);
        int quiet = 0;
        for (int i = 0; i < steps; ++i) quiet += walk.go();
        EXPECT_GT(walk.changes, 5);
        if (longest < 1e-4) EXPECT_GT(quiet, 0.7 * steps);
      }
}

TEST(MeshWatch, LooksAgainWithJointsSideBySideAndInAnotherMesh) {
  auto model = std::make_shared<const BeamModel>(line_with_bodies({0.305, 0.395}));
  const auto system = std::make_shared<const BeamSystem>(model, initial_plan(*model));
  const State state = drawn_state(*system);
  MeshWatch watch;
  EXPECT_FALSE(watch.is_quiet(system, state));
  const NextPlan next = next_plan(*system, state, LengthControl{});
  ASSERT_EQ(next.change, MeshChange::none);
  watch.look(system, next);
  EXPECT_FALSE(watch.is_quiet(system, state)) << "the other one moves what this one is measured by";

  auto alone = std::make_shared<const BeamModel>(line_with_bodies({0.305}));
  const auto one = std::make_shared<const BeamSystem>(alone, initial_plan(*alone)),
             other = std::make_shared<const BeamSystem>(alone, initial_plan(*alone));
  const State start = drawn_state(*one);
  watch.look(one, next_plan(*one, start, LengthControl{}));
  EXPECT_TRUE(watch.is_quiet(one, start));
  EXPECT_FALSE(watch.is_quiet(other, start));
}

TEST(PointForGood, GivesUpTheNodeAndBringsHiddenOnesBack) {
  const auto model = std::make_shared<const BeamModel>(line_with_bodies({0.231}));
  const auto system = std::make_shared<const BeamSystem>(model, initial_plan(*model));
  ASSERT_EQ(system->mesh().plan.modes[0], Carried::node);
  const auto next = point_for_good(*system, drawn_state(*system), {}, 0);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->change, MeshChange::becomes_point);
  EXPECT_EQ(next->plan.modes[0], Carried::point);
  EXPECT_EQ(std::ranges::count(next->plan.beams[0].present, false), 0);
  const auto after = std::make_shared<const BeamSystem>(model, next->plan);
  State state = drawn_state(*after);
  EXPECT_EQ(next_plan(*after, state, {}).change, MeshChange::none);
  MeshPlan free = next->plan;
  free.points_for_good.clear();
  const auto otherwise = std::make_shared<const BeamSystem>(model, free);
  EXPECT_EQ(next_plan(*otherwise, drawn_state(*otherwise), {}).change, MeshChange::becomes_node);
  EXPECT_FALSE(point_for_good(*after, state, {}, 0)) << "it is one";
}

TEST(PointForGood, IsNotForAKink) {
  const auto model = std::make_shared<const BeamModel>(line_with_bodies({0.231}, false));
  const auto system = std::make_shared<const BeamSystem>(model, initial_plan(*model));
  EXPECT_FALSE(point_for_good(*system, drawn_state(*system), {}, 0));
}

}  // namespace
}  // namespace nurbeam
