// Every row of `nurbeam verify` passes, the orders of its convergence tables among them.

#include <gtest/gtest.h>

#include <algorithm>

#include "pipelines/verification/verify.h"

namespace nurbeam {
namespace {

class Verification : public ::testing::TestWithParam<VerifyProblem> {};

TEST_P(Verification, AgreesWithTheKnownAnswer) {
  const VerifyResult result = GetParam().run();
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
