// The comparison with Ding & Ouyang 2022 on a few meshes; all of it is `nurbeam verify papers`.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "pipelines/papers/papers_chains.h"
#include "pipelines/papers/papers_events.h"
#include "pipelines/papers/papers_places.h"

namespace nurbeam::papers {
namespace {

papers::Run coarse_run(const Example& example, int elements, const Method& method) {
  return run(example.model(elements), method, {.end = example.end, .step = 1e-3, .every = 0.02});
}

TEST(Papers, OurEventsChangeTheEnergyFiveTimesLessThanThePapersAndNeverMore) {
  for (const auto& [example, elements] : {std::pair{falling_beam_example(), 5},
                                          {suspended_beam_example(), 3},
                                          {suspended_beam_example(), 8},
                                          {semicircle_example(false), 12}}) {
    SCOPED_TRACE(example.name + ", " + std::to_string(elements) + " elements");
    const papers::Run own = coarse_run(example, elements, ours());
    const EventJumps jumps = jumps_of(own);
    EXPECT_TRUE(meets_target(jumps.rms_energy, jumps_of(coarse_run(example, elements, all_ones())).rms_energy,
                             jumps_of(coarse_run(example, elements, paper_rule())).rms_energy))
        << jumps.rms_energy;
    EXPECT_FALSE(destroyed(own, own.report.peak_kinetic_energy));
    EXPECT_GT(jumps.events, 0);
    EXPECT_LE(jumps.rms_energy, jumps.largest_energy);
  }
}

TEST(Papers, OurEventsChangeTheMomentumByTheSupportsImpulseOnly) {
  const papers::Run own = coarse_run(suspended_beam_example(), 5, ours());
  EXPECT_LT(jumps_of(own).largest_momentum, 1e-12);
  double largest = 0;
  for (const MeshChangeRecord& change : own.changes)
    largest = std::max(largest, change.event.support_impulse.norm());
  EXPECT_GT(largest, 1e-3);  // the supports do push
  EXPECT_GT(jumps_of(coarse_run(suspended_beam_example(), 5, paper_rule())).largest_momentum, 1e-3);
}

TEST(Papers, ARemovedNodeIsGoneAndTheOthersKeepTheirPlaces) {
  const papers::Run own = coarse_run(suspended_beam_example(), 3, ours());
  ASSERT_FALSE(own.changes.empty());
  for (const MeshChangeRecord& change : own.changes) {
    const std::size_t before = change.before.node_s.size(), after = change.after.node_s.size();
    if (change.event.kind == EventKind::merge) EXPECT_LE(after, before);
    if (change.event.kind == EventKind::split) EXPECT_GT(after, before);
    EXPECT_EQ(change.after.elements.size() + 1, after);
  }
}

TEST(Papers, ABodyThatTurnsBehindAJointComesBackOverIt) {
  const Example example = reversing_example();
  const double last_joint = 1 + M_PI / 2;
  const papers::Run own = run(example.model(12), ours(), {.end = example.end, .step = 1e-3, .every = 0.02});
  ASSERT_TRUE(own.complete());
  double farthest = 0;
  for (const Snapshot& frame : own.frames) farthest = std::max(farthest, frame.bodies[0].s.value());
  EXPECT_GT(farthest, last_joint);
  EXPECT_LT(own.frames.back().bodies[0].s.value(), last_joint);
  const papers::Run rule =
      run(example.model(12), paper_rule(), {.end = example.end, .step = 1e-3, .every = 0.02});
  EXPECT_LT(5 * jumps_of(own).rms_energy, jumps_of(rule).rms_energy);
}

TEST(Papers, TheReferencesAreMet) {
  const papers::Run own =
      run(suspended_beam_example().model(24), ours(), {.end = 1, .step = 5e-4, .every = 0.1});
  EXPECT_LT(largest_distance(own, references::suspended_beam()), 5e-4);
  EXPECT_DOUBLE_EQ(rms_distance(own, own), 0);
}

}  // namespace
}  // namespace nurbeam::papers
