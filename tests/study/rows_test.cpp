#include "pipelines/study/rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/study/study_text.h"

namespace nurbeam {
namespace {

Variant variant_number(std::size_t n) {
  return {
      .number = n, .values = {0.1 * static_cast<double>(n), 1.0 / 3}, .quantities = {1e-300}, .seconds = 0.5};
}

TEST(StudyRows, GoOnWhereTheyEnded) {
  const test::TemporaryDirectory directory;
  const auto file = directory.path() / "study.rows";
  {
    StudyRows rows(file, {"digest", {}}, false);
    for (const std::size_t n : {0, 2, 1}) rows.append(variant_number(n));
  }
  std::ofstream(file, std::ios::app) << R"({"number":3,"values":[0.3)";  // killed in the middle of a line
  StudyRows rows(file, {"digest", {}}, true);
  ASSERT_EQ(rows.stored().size(), 3U);
  EXPECT_EQ(rows.stored().at(2).values, variant_number(2).values) << "to the last bit";
  EXPECT_EQ(rows.stored().at(2).quantities, (std::vector<double>{1e-300}));
  rows.append(variant_number(3));
  rows.synchronise();
}

TEST(StudyRows, OutliveASecondStudyThatIsRefused) {
  const test::TemporaryDirectory directory;
  const auto file = directory.path() / "study.rows";
  {
    StudyRows rows(file, {"digest", {}}, false);
    rows.append(variant_number(0));
    for (const bool resume : {true, false})
      EXPECT_THROW(StudyRows(file, {"digest", {}}, resume), StudyRowsError) << "another one holds them";
    rows.append(variant_number(1));
  }
  EXPECT_EQ(StudyRows(file, {"digest", {}}, true).stored().size(), 2U);
  EXPECT_EQ(StudyRows(file, {"digest", {}}, false).stored().size(), 0U);
  EXPECT_EQ(StudyRows(file, {"digest", {}}, true).stored().size(), 0U) << "begun anew";
}

TEST(StudyRows, OfAnotherStudyAreRefused) {
  const test::TemporaryDirectory directory;
  const auto file = directory.path() / "study.rows";
  const auto told = [&](const StudyIdentity& study) -> std::string {
    try {
      const StudyRows rows(file, study, true);
    } catch (const UnusableRowsError& problem) {
      return problem.what();
    }
    return "";
  };
  const StudyIdentity here{"digest", {{"a", "1"}, {"b", "2"}, {"c", "3"}}};
  { const StudyRows rows(file, here, false); }
  EXPECT_EQ(told(here), "");
  EXPECT_EQ(
      told({"other", {{"a", "1"}, {"b", "3"}, {"d", "3"}}}),
      file.string() +
          ": belongs to another study: changed since: b, c, d; run without --resume, which begins anew, or into "
          "another directory by --out");
  std::ofstream(file) << R"({"nurbeam_study_rows":1,"digest":"digest"})"
                      << "\n";  // of earlier versions
  EXPECT_NE(told(here).find("has no checksums"), std::string::npos);
  EXPECT_NE(told({"other", here.parts}).find("changed since: the study, its case, a CAD file or nurbeam"),
            std::string::npos);
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Where the end of the last line is damaged, that line is not whole, and its variant runs again.
TEST(StudyRows, WithABitFlippedAreRefusedOrFewer) {
  const test::TemporaryDirectory directory;
  const auto file = directory.path() / "study.rows";
  const StudyIdentity study{"digest", {{"a", "1"}}};
  {
    StudyRows rows(file, study, false);
    for (const std::size_t n : {0, 1, 2}) rows.append(variant_number(n));
  }
  const std::string whole = content_of(file);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    std::ofstream(file, std::ios::binary) << damaged;
    try {
      const StudyRows rows(file, study, true);
      EXPECT_EQ(at, whole.size() - 1);
      EXPECT_EQ(rows.stored().size(), 2U);
    } catch (const UnusableRowsError& problem) {
      EXPECT_NE(std::string(problem.what()).find(file.string()), std::string::npos) << problem.what();
    }
  }
}

TEST(StudyRows, OfWhichOneIsOfAnotherStudyAreRefused) {
  const test::TemporaryDirectory directory;
  const auto file = directory.path() / "study.rows", other = directory.path() / "other.rows";
  {
    StudyRows rows(file, {"digest", {}}, false), others(other, {"other", {}}, false);
    rows.append(variant_number(0));
    others.append(variant_number(1));
  }
  const std::string lines = content_of(other);
  std::ofstream(file, std::ios::app) << lines.substr(lines.find('\n') + 1);
  try {
    const StudyRows rows(file, {"digest", {}}, true);
    ADD_FAILURE();
  } catch (const UnusableRowsError& problem) {
    EXPECT_NE(std::string(problem.what()).find("line 3 is damaged or was changed"), std::string::npos)
        << problem.what();
  }
}

TEST(StudyRows, AVariantSurvivesItsLine) {
  Variant failed{.number = 7,
                 .values = {std::nextafter(1.0, 2.0)},
                 .status = VariantStatus::timed_out,
                 .reason = "took \"long\"\nand longer",
                 .seconds = 3};
  const Variant back = variant_of(line_of(failed));
  EXPECT_EQ(back.number, failed.number);
  EXPECT_EQ(back.values, failed.values);
  EXPECT_EQ(back.status, failed.status);
  EXPECT_EQ(back.reason, failed.reason);
  const Variant steep = variant_of(line_of({.number = 8, .gradient = {{1.5, HUGE_VAL}, {}}}));
  ASSERT_EQ(steep.gradient.size(), 2U);
  EXPECT_EQ(steep.gradient[0][0], 1.5);
  EXPECT_TRUE(std::isnan(steep.gradient[0][1]));
  EXPECT_THROW(variant_of("{}"), std::runtime_error);
}

}  // namespace
}  // namespace nurbeam
