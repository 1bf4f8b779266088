#include "pipelines/diagnostics/joined_warnings.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace nurbeam {
namespace {

std::vector<Diagnostic> of_beams(Severity severity, int count) {
  std::vector<Diagnostic> all;
  for (int i = 0; i < count; ++i)
    all.push_back({severity, "case.json: beams[" + std::to_string(i) + "].material.density", "is 7.85"});
  return all;
}

TEST(JoinedWarnings, OfManyBeamsBecomeOneWithACount) {
  const std::vector<Diagnostic> two = joined_warnings(of_beams(Severity::warning, 2));
  ASSERT_EQ(two.size(), 1u);
  EXPECT_EQ(two[0].where, "case.json: beams[0].material.density");
  EXPECT_EQ(two[0].message, "is 7.85; the same of 1 other: beams[1]");
  const std::vector<Diagnostic> twelve = joined_warnings(of_beams(Severity::note, 12));
  ASSERT_EQ(twelve.size(), 1u);
  EXPECT_EQ(twelve[0].message, "is 7.85; the same of 11 others: beams[1], beams[2], beams[3], ...");
}

TEST(JoinedWarnings, KeepErrorsAndWhatDiffers) {
  EXPECT_EQ(joined_warnings(of_beams(Severity::error, 3)), of_beams(Severity::error, 3));
  const std::vector<Diagnostic> other_key = {{Severity::warning, "c: beams[0].a", "is 1"},
                                             {Severity::warning, "c: beams[1].b", "is 1"},
                                             {Severity::warning, "c: beams[2].a", "is 2"},
                                             {Severity::note, "c: beams[3].a", "is 1"}};
  EXPECT_EQ(joined_warnings(other_key), other_key);
}

}  // namespace
}  // namespace nurbeam
