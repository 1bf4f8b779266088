#include "pipelines/verification/verify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "pipelines/command/command_line.h"
#include "pipelines/papers/verify_command.h"
#include "pipelines/results/verified_table.h"

namespace nurbeam {
namespace {

struct Outcome {
  int code;
  std::string out, err;
};

Outcome run(const std::vector<VerifyProblem>& problems) {
  std::ostringstream out, err;
  const int code = print_results(problems, run_all(problems, err), out);
  return {code, out.str(), err.str()};
}

Outcome run_words(const std::vector<std::string>& words) {
  std::ostringstream out, err;
  const int code = run_command_line({verify_entry(verify_command)}, words, out, err);
  return {code, out.str(), err.str()};
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

VerifyProblem problem(const std::string& name, double computed) {
  return {name, "material, Green, straight",
          [=] {
            VerifyResult result;
            result.add("tip [m]", 1, "a book", computed, 1e-3);
            return result;
          }};
}

TEST(Verify, PrintsEveryRowInOrderAndCountsThem) {
  const Outcome outcome = run({problem("first", 1), problem("second", 1.0005)});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out,
            "problem  quantity  reference  computed  error   tolerance  pass  "
            "curvature, strain, stress-free  source\n"
            "first    tip [m]   1          1         0       0.001      yes   "
            "material, Green, straight       a book\n"
            "second   tip [m]   1          1.0005    0.0005  0.001      yes   "
            "material, Green, straight       a book\n"
            "\n2 passed, 0 failed\n");
}

TEST(Verify, FailsWithCodeOneWhenARowFails) {
  for (const double computed : {1.002, 0.998, std::nan("")}) {
    const Outcome outcome = run({problem("good", 1), problem("bad", computed)});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(outcome.out.ends_with("\n1 passed, 1 failed\n")) << outcome.out;
  }
}

TEST(Verify, MakesAFailedRowOfAProblemThatThrows) {
  const VerifyProblem broken{"broken", "", []() -> VerifyResult { throw std::runtime_error("it diverges"); }};
  const Outcome outcome = run({broken, problem("good", 1)});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(holds(outcome.out, "it diverges"));
  EXPECT_TRUE(outcome.out.ends_with("\n1 passed, 1 failed\n"));
}

TEST(Verify, AsksForAnOrderOfConvergenceFromBelowOnly) {
  const auto table = [](double finest) {
    return VerifyProblem{
        "cubic", "", [=] {
          VerifyResult result;
          result.add({"the tip [m]", "elements", {{4, 16e-3}, {8, 1e-3}, {16, finest}}}, 4, 0.1, "theory");
          return result;
        }};
  };
  EXPECT_EQ(run({table(1e-3 / 16)}).code, 0);
  EXPECT_EQ(run({table(1e-3 / 64)}).code, 0);
  EXPECT_EQ(run({table(1e-3 / 14)}).code, 1);
  EXPECT_EQ(run({table(std::nan(""))}).code, 1);
  EXPECT_TRUE(holds(run({table(1e-3 / 64)}).out,
                    "\ncubic: the tip [m]\n  elements  error     order\n  4         0.016     \n"
                    "  8         0.001     4\n  16        1.56e-05  6\n"));
}

TEST(Verified, HoldsTheErrorsOfNumbersWithAReference) {
  VerifyResult result;
  result.add("order", 4, "theory", 3, 2);
  result.rows[0].at_least = true;
  result.add("tip [m]", 2, "a book", 2.0002, 1);
  result.add("gap [m]", 0, "a book", -1e-6, 1);
  result.add("zero by symmetry [m]", 0, "a book", 0, 1);
  result.features = {"torsion"};
  const std::vector<VerifiedProblem> found = verified({{"one", "", {}}}, {result});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rows, 2);
  EXPECT_NEAR(found[0].least, 1e-6, 1e-15);
  EXPECT_NEAR(found[0].greatest, 1e-4, 1e-12);
  EXPECT_EQ(found[0].features, Features{"torsion"});
}

// After a change: nurbeam verify --write pipelines/results/verified.tsv.
TEST(VerifiedTable, NamesTheProblemsAndFeaturesOfToday) {
  const std::vector<VerifyProblem> problems = verification_problems();
  const std::vector<VerifiedProblem> table = read_verified(verified_table);
  ASSERT_EQ(table.size(), problems.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(table[i].name, problems[i].name);
    EXPECT_TRUE(std::ranges::includes(all_features(), table[i].features)) << table[i].name;
    EXPECT_FALSE(table[i].features.empty()) << table[i].name;
  }
}

TEST(VerificationProblems, HaveDifferentNames) {
  const std::vector<VerifyProblem> problems = verification_problems();
  for (std::size_t i = 0; i < problems.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(problems[i].name, problems[j].name);
}

TEST(VerifyCommand, RunsTheProblemsWhoseNameHoldsTheWord) {
  const Outcome outcome = run_words({"verify", "catenary"});
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_TRUE(holds(outcome.out, "catenary-slack"));
  EXPECT_FALSE(holds(outcome.out, "roll-up"));
  EXPECT_TRUE(outcome.out.ends_with(" passed, 0 failed\n"));
}

TEST(VerifyCommand, RefusesWhatItDoesNotKnow) {
  const Outcome unknown = run_words({"verify", "rol-up"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(holds(unknown.err, "did you mean \"roll-up\"")) << unknown.err;
  EXPECT_EQ(run_words({"verify", "--for", "missing.json"}).code, 2);
  const Outcome part = run_words({"verify", "roll-up", "--write", "verified.tsv"});
  EXPECT_EQ(part.code, 2);
  EXPECT_TRUE(holds(part.err, "leave out the name and --for")) << part.err;
}

}  // namespace
}  // namespace nurbeam
