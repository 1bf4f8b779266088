#include "pipelines/model/features.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipelines/verification/feature_models.h"
#include "pipelines/verification/models.h"

namespace nurbeam {
namespace {

TEST(Features, AreThoseOfAllPartsOfAModel) {
  BeamModel model =
      verification::one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {1e4, 1, 1, 0.1, {}}, 4, {{0, true}});
  verification::add_slider(model, 1, 0.4);
  model.riders[0].continuous_slope = false;
  model.riders[0].friction = Friction{.coefficient = 0.2, .law = Friction::Law::capstan, .viscous = 1};
  verification::add_force(model, {0, 1, 0}, 1, 2);
  EXPECT_EQ(features_of(model),
            (Features{"axial strain: assumed", "clamped", "curvature: material", "damping of strain",
                      "discontinuous slope", "element: material weights", "friction: capstan", "gravity",
                      "law: green", "load that moves", "plane", "point force", "sliding body",
                      "stress-free: as drawn", "viscous resistance"}));
}

TEST(Features, HoldTheAnalysis) {
  EXPECT_EQ(features_of(SimulationOptions{.statics = true}), Features{"statics"});
  EXPECT_EQ(features_of(SimulationOptions{.step = 0.1, .integrator = Radau{}}),
            (Features{"integrator: radau", "motion"}));
  EXPECT_EQ(features_of(ModesOptions{.kind = ModesOptions::Kind::buckling}), Features{"buckling"});
}

TEST(Features, HaveKnownNames) {
  for (const verification::FeatureModel& each : verification::feature_models()) {
    const Features found = features_of(each.model);
    EXPECT_TRUE(std::ranges::includes(all_features(), found)) << each.name;
  }
}

}  // namespace
}  // namespace nurbeam
