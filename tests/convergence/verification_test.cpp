// Every row of `nurbeam verify` passes, the orders of its convergence tables among them.

#include <gtest/gtest.h>

#include <algorithm>

#include "pipelines/results/verified_table.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {
namespace {

class Verification : public ::testing::TestWithParam<VerifyProblem> {};

Features features_in_table(const std::string& name) {
  for (const VerifiedProblem& problem : read_verified(verified_table))
    if (problem.name == name) return problem.features;
  return {};
}

TEST_P(Verification, AgreesWithTheKnownAnswer) {
  (void)verification::take_noted();
  const VerifyResult result = GetParam().run();
  EXPECT_EQ(verification::take_noted(), features_in_table(GetParam().name))
      << "make the table anew: nurbeam verify --write pipelines/results/verified.tsv";
  EXPECT_FALSE(result.rows.empty());
  for (const VerifyRow& row : result.rows)
    EXPECT_TRUE(row.passes()) << row.quantity << ": " << row.computed << ", not " << row.reference << " ("
                              << row.source << "); error " << row.error() << ", tolerance " << row.tolerance;
}

std::string test_name(const ::testing::TestParamInfo<VerifyProblem>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Problem, Verification, ::testing::ValuesIn(verification_problems()), test_name);

}  // namespace

// What a failed test prints of its parameter.
void PrintTo(const VerifyProblem& problem, std::ostream* stream) { *stream << problem.name; }

}  // namespace nurbeam
