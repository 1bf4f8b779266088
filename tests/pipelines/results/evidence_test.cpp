#include "pipelines/results/evidence.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace nurbeam {
namespace {

const std::vector<VerifiedProblem> verified{{"far", 3, 2e-6, 1e-3, {"friction", "plane", "ring", "wind"}},
                                            {"near", 1, 5e-5, 5e-5, {"friction", "plane"}},
                                            {"rough", 2, 1e-2, 2e-2, {"friction", "plane", "torsion"}}};

TEST(Evidence, ATableIsReadAsItWasWritten) {
  const std::vector<VerifiedProblem> read = read_verified(text_of(verified));
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(read[0].name, "far");
  EXPECT_EQ(read[0].rows, 3);
  EXPECT_DOUBLE_EQ(read[0].least, 2e-6);
  EXPECT_DOUBLE_EQ(read[0].greatest, 1e-3);
  EXPECT_EQ(read[0].features, verified[0].features);
  EXPECT_TRUE(read_verified("").empty());
  EXPECT_THROW((void)read_verified("far\t3\n"), std::invalid_argument);
}

TEST(Evidence, CloseAnswersThatHaveMostInCommonComeFirst) {
  const std::vector<FeatureEvidence> evidence = evidence_for({"friction", "plane"}, verified);
  ASSERT_EQ(evidence.size(), 2u);
  EXPECT_EQ(evidence[0].feature, "friction");
  ASSERT_EQ(evidence[0].problems.size(), 3u);
  EXPECT_EQ(evidence[0].problems[0].name, "near");
  EXPECT_EQ(evidence[0].problems[1].name, "far");
  EXPECT_EQ(evidence[0].problems[2].name, "rough");
}

TEST(Evidence, AFeatureThatNoAnswerMeetsCloselyIsNotCovered) {
  for (const FeatureEvidence& evidence : evidence_for({"friction", "snow", "torsion"}, verified))
    EXPECT_EQ(evidence.is_covered(), evidence.feature == "friction") << evidence.feature;
}

}  // namespace
}  // namespace nurbeam
