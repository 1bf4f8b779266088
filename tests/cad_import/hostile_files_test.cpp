#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <iterator>
#include <random>

#include "cad_import/files/child_process.h"
#include "cad_import/import_curves.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_text_of.h"
#include "tests/fuzz/warm_reader.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> files{"igesio-sample-curves.igs", "iges-126-bsplines.igs",
                                     "iges-104-conics.igs",      "dealii-line.iges",
                                     "dealii-line.step",         "rhino-sliced-cylinder.step"};

// The report is an error that names the file; the test's own process goes on.
void expect_error(const ImportReport& report, const fs::path& file, const std::string& word) {
  EXPECT_FALSE(report.ok()) << file;
  EXPECT_TRUE(report.curves.empty()) << file;
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_NE(report.diagnostics[0].where.find(file.filename().string()), std::string::npos);
  EXPECT_NE(report.diagnostics[0].message.find(word), std::string::npos) << report.diagnostics[0].message;
}

// Curves, or the reason why there are none.
void expect_an_answer(const ImportReport& report, const std::string& what) {
  EXPECT_TRUE(!report.ok() || !report.curves.empty()) << what;
}

int open_descriptors() {
  return static_cast<int>(std::distance(fs::directory_iterator("/proc/self/fd"), {}));
}

TEST(HostileFile, WhatIsNoFileIsAnError) {
  const ScratchDirectory scratch;
  expect_error(import_curves(scratch.path() / "missing.step"), "missing.step", "no such file");
  expect_error(import_curves(scratch.path() / "no" / "missing.step"), "missing.step", "there is no folder");
  expect_error(import_curves(scratch.path() / "missing.step"), "missing.step",
               "no CAD file is in its folder");
  scratch.file("there.igs", "x");
  expect_error(import_curves(scratch.path() / "missing.step"), "missing.step", "there are: there.igs");
  expect_error(import_curves(scratch.path()), scratch.path(), "directory");
  expect_error(import_curves("/dev/null"), "/dev/null", "not a regular file");
}

TEST(HostileFile, WhatIsNeitherStepNorIgesIsAnErrorThatSaysWhatWasExpected) {
  const ScratchDirectory scratch;
  expect_error(import_curves(scratch.file("a.step", "")), "a.step", "empty");
  expect_error(import_curves(scratch.file("b.step", std::string(5000, '\0'))), "b.step", "ISO-10303-21");
  expect_error(import_curves(scratch.file("c.igs", "solid stl\nfacet\n")), "c.igs", "column 73");
  expect_error(import_curves(scratch.file("d.step", "ISO-10303-21;\nEND-ISO-10303-21;\n")), "d.step", "");
}

TEST(HostileFile, ATruncatedFileIsAnError) {
  const ScratchDirectory scratch;
  for (const std::string& name : files) {
    const std::string whole = content_of(corpus_file(name));
    for (int percent : {10, 30, 50, 70, 90}) {
      const fs::path file = scratch.file(name, whole.substr(0, whole.size() * percent / 100));
      expect_error(import_curves(file), file, "truncated");
    }
  }
}

TEST(HostileFile, ATruncatedFileThatPretendsToBeWholeIsAnswered) {
  const ScratchDirectory scratch;
  for (const std::string& name : files) {
    const bool step = name.ends_with(".step");
    const std::string whole = content_of(corpus_file(name));
    const std::string terminate = "\nS0000001G0000003D0000002P0000001" + std::string(40, ' ') + "T      1\n";
    for (int percent : {10, 30, 50, 70, 90}) {
      const std::string part = whole.substr(0, whole.size() * percent / 100);
      const fs::path file = scratch.file(name, part + (step ? ";\nENDSEC;\nEND-ISO-10303-21;\n" : terminate));
      expect_an_answer(import_curves(file, {.time_limit = std::chrono::seconds(5)}), name);
    }
  }
}

/// Files with one changed byte each, and where it is.
std::vector<std::string> changed_files(const std::string& name, int count, std::mt19937& random,
                                       const ScratchDirectory& scratch) {
  const std::string whole = content_of(corpus_file(name));
  std::vector<std::string> changed;
  for (int i = 0; i < count; ++i) {
    std::string content = whole;
    const std::size_t at = random() % content.size();
    content[at] = static_cast<char>(random() % 256);
    changed.push_back(scratch.file(std::to_string(at) + "_" + std::to_string(i) + name, content));
  }
  return changed;
}

// Many in one child with OpenCASCADE warm; those that end it, and every twentieth, as any file is read.
TEST(HostileFile, AFileWithOneChangedByteIsAnswered) {
  constexpr std::chrono::seconds time_limit{5};
  const ScratchDirectory scratch;
  std::mt19937 random(20240521);
  const int before = open_descriptors();
  for (const std::string& name : files) {
    std::vector<std::string> left = changed_files(name, 60, random, scratch);
    while (!left.empty()) {
      const std::vector<ImportReport> reports = warm_reports(left, time_limit, std::size_t{2} << 30);
      for (std::size_t i = 0; i < reports.size(); ++i) {
        expect_an_answer(reports[i], left[i]);
        if (i % 20 > 0) continue;
        const ImportReport alone = import_curves(left[i], {.time_limit = time_limit});
        // Alone, a crash costs an entity where the reader with OpenCASCADE warm loses the file.
        if (!reports[i].ok()) {
          EXPECT_FALSE(alone.diagnostics.empty()) << left[i];  // which names it
          continue;
        }
        EXPECT_TRUE(alone.ok()) << left[i];
        EXPECT_EQ(alone.curves.size(), reports[i].curves.size()) << left[i];
      }
      left.erase(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(reports.size()));
    }
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
}

TEST(HostileFile, KnotsThatAreNoNumbersGiveNoCurve) {
  const ScratchDirectory scratch;
  const std::string whole = content_of(corpus_file("dealii-line.step"));
  for (const std::string knot : {"NAN", "1E9999", "-1E9999", "INF", "-1."}) {
    const fs::path file = scratch.file("knots.step", with(whole, "(0.,1.,2.,3.)", "(0.," + knot + ",2.,3.)"));
    const ImportReport report = import_curves(file);
    EXPECT_FALSE(report.ok()) << knot;
    EXPECT_TRUE(report.curves.empty()) << knot;
  }
}

TEST(HostileFile, CoordinatesThatAreNoNumbersGiveNoCurve) {
  const ScratchDirectory scratch;
  const std::string whole = content_of(corpus_file("dealii-line.step"));
  for (const std::string number : {"NAN", "1E9999"}) {
    const fs::path file = scratch.file("point.step", with(whole, "(-0.388888888889,", "(" + number + ","));
    const ImportReport report = import_curves(file);
    for (const ImportedCurve& curve : report.curves) EXPECT_TRUE(curve.curve.control_points().allFinite());
    expect_an_answer(report, number);
  }
}

TEST(HostileFile, WithoutAnyCurveSaysWhyInTheError) {
  const ScratchDirectory scratch;
  const auto error_of = [&](const std::string& text) {
    const ImportReport report = import_curves(scratch.file("empty.cad", text));
    EXPECT_FALSE(report.ok());
    return report.diagnostics.empty() ? "" : report.diagnostics.back().message;
  };
  const std::string ray =
      error_of(iges_text_of({{.type = 110, .parameters = "110,0,0,0,1,0,0;", .form = 1, .label = "axis"}}));
  EXPECT_NE(ray.find("D1 Line 'axis'"), std::string::npos) << ray;
  EXPECT_NE(ray.find("it is a ray"), std::string::npos) << ray;
  const std::string circles =
      error_of(step_text_of("#100,#101", "#100 = CIRCLE('',#11,-1.);\n#101 = CIRCLE('',#11,-2.);\n"));
  EXPECT_NE(circles.find("its radius is -1; it must be positive; #101 Circle"), std::string::npos) << circles;
  EXPECT_NE(error_of(step_text_of("#13", "")).find("expected at least one"), std::string::npos);
}

TEST(HostileFile, OnlyTheDamagedCurveOfAFileIsSkippedAndItIsNamed) {
  const ScratchDirectory scratch;
  const std::string curves = R"(#100 = CIRCLE('good',#11,1.);
#101 = B_SPLINE_CURVE_WITH_KNOTS('bad',1,(#110,#111,#112),.UNSPECIFIED.,.F.,.F.,(2,1,2),(0.,-1.,2.),.UNSPECIFIED.);
#110 = CARTESIAN_POINT('',(0.,0.,0.));
#111 = CARTESIAN_POINT('',(1.,2.,0.));
#112 = CARTESIAN_POINT('',(2.,0.,0.));)";
  const ImportReport report = import_curves(scratch.file("knots.step", step_text_of("#100,#101", curves)));
  EXPECT_TRUE(report.ok());
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_EQ(report.curves[0].name, "good");
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].where.find("#101"), std::string::npos);
  EXPECT_NE(report.diagnostics[0].message.find("must not decrease"), std::string::npos);
}

TEST(HostileFile, DecreasingKnotsInIgesGiveNoCurve) {
  const ScratchDirectory scratch;
  const std::string whole = content_of(corpus_file("dealii-line.iges"));
  const fs::path file = scratch.file("knots.igs", with(whole, "0.,0.,0.,0.,1.,2.,", "0.,0.,0.,0.,2.,1.,"));
  expect_error(import_curves(file), file, "Knots are not in ascending order");
}

TEST(HostileFile, ALostLineOfAnIgesFileIsAWarning) {
  const ScratchDirectory scratch;
  const std::string whole = content_of(corpus_file("igesio-sample-curves.igs"));
  const fs::path file = scratch.file("lost.igs", with(whole, "13P      9", "13X      9"));
  const ImportReport report = import_curves(file);
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].message.find("section P"), std::string::npos);
}

TEST(HostileFile, ADegreeThatIsNoNumberIsAWarningThatNamesTheEntity) {
  const ScratchDirectory scratch;
  const std::string whole = content_of(corpus_file("igesio-sample-curves.igs"));
  const fs::path file = scratch.file("word.igs", with(whole, "126,3,3,", "126,3,x,"));
  const ImportReport report = import_curves(file);
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].where.find("D1 BSplineCurve"), std::string::npos);
}

TEST(HostileFile, NegativeWeightsGiveNoCurve) {
  const ScratchDirectory scratch;
  const std::string whole = content_of(corpus_file("iges-126-bsplines.igs"));
  const std::string curve =
      R"(#100 = ( BOUNDED_CURVE() B_SPLINE_CURVE(2,(#110,#111,#112),.UNSPECIFIED.,.F.,.F.)
B_SPLINE_CURVE_WITH_KNOTS((3,3),(0.,1.),.UNSPECIFIED.) CURVE() GEOMETRIC_REPRESENTATION_ITEM()
RATIONAL_B_SPLINE_CURVE((1.,-1.,1.)) REPRESENTATION_ITEM('negative') );
#110 = CARTESIAN_POINT('',(0.,0.,0.));
#111 = CARTESIAN_POINT('',(1.,2.,0.));
#112 = CARTESIAN_POINT('',(2.,0.,0.));)";
  const ImportReport report = import_curves(scratch.file("weights.step", step_text_of("#100", curve)));
  EXPECT_TRUE(report.curves.empty());
  EXPECT_FALSE(report.ok());
}

TEST(HostileFile, DeepNestingIsAnError) {
  const ScratchDirectory scratch;
  const std::string nested = std::string(200'000, '(') + std::string(200'000, ')');
  const std::string text = step_text_of("#100", "#100 = CIRCLE('',#11," + nested + ");");
  const ImportReport report = import_curves(scratch.file("deep.step", text));
  EXPECT_FALSE(report.ok());
  EXPECT_TRUE(report.curves.empty());
}

TEST(HostileFile, ACurveThatTrimsItselfIsAnError) {
  const ScratchDirectory scratch;
  const std::string loop =
      "#100 = TRIMMED_CURVE('',#100,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);";
  const ImportReport report = import_curves(scratch.file("loop.step", step_text_of("#100", loop)));
  EXPECT_FALSE(report.ok());
  EXPECT_TRUE(report.curves.empty());
}

TEST(HostileFile, TheTimeLimitIsAnErrorThatNamesIt) {
  const ImportReport report =
      import_curves(corpus_file("parastell-magnet.step"), {.time_limit = std::chrono::seconds(0)});
  expect_error(report, "parastell-magnet.step", "time limit of 0 s");
}

TEST(HostileFile, AFileThatTakesForEverEndsAtTheTimeLimit) {
  const ScratchDirectory scratch;
  std::string references = "#100";
  for (int i = 0; i < 100'000; ++i) references += ",#100";
  const fs::path file = scratch.file("slow.step", step_text_of(references, "#100 = CIRCLE('',#11,1.);"));
  const auto begin = std::chrono::steady_clock::now();
  const ImportReport report = import_curves(file, {.time_limit = std::chrono::seconds(1)});
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(4));
  expect_error(report, file, "time limit of 1 s");
}

// Twice as many segments at each level: 2^40 in a file of a few kilobytes.
TEST(HostileFile, ANestOfCompositeCurvesIsRefusedAtOnce) {
  const ScratchDirectory scratch;
  std::string entities = "#100 = CIRCLE('',#11,1.);\n", below = "#100";
  std::vector<IgesEntity> iges{{.type = 110, .parameters = "110,0.,0.,0.,1.,0.,0.;"}};
  for (int level = 0; level < 40; ++level) {
    const int id = 101 + 3 * level;
    const auto reference = [&](int i) { return "#" + std::to_string(id + i); };
    for (int i : {0, 1})
      entities += reference(i) + " = COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.," + below + ");\n";
    entities += reference(2) + " = COMPOSITE_CURVE('',(" + reference(0) + "," + reference(1) + "),.F.);\n";
    below = reference(2);
    const std::string pointer = std::to_string(2 * level + 1);
    iges.push_back({.type = 102, .parameters = "102,2," + pointer + "," + pointer + ";"});
  }
  for (const fs::path& file : {scratch.file("nest.step", step_text_of(below, entities)),
                               scratch.file("nest.igs", iges_text_of(iges))}) {
    const ImportReport report = import_curves(file, {.time_limit = std::chrono::seconds(5)});
    expect_error(report, file, "repeats other curves until it has");
  }
}

TEST(HostileFile, AFileOfAGigabyteIsRefusedAtOnce) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.file("large.step", "ISO-10303-21;\n");
  fs::resize_file(file, std::uintmax_t{1} << 30);  // sparse: it takes no room
  const auto begin = std::chrono::steady_clock::now();
  expect_error(import_curves(file), file, "1024 MiB, more than the limit of 512 MiB");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

TEST(HostileFile, AFileWithinTheSizeLimitIsReadWithinTheMemoryLimit) {
  if (!can_limit_memory()) GTEST_SKIP() << "built with the address sanitizer";
  const ScratchDirectory scratch;
  const fs::path file = scratch.file("blank.step", "ISO-10303-21;\n");
  fs::resize_file(file, std::uintmax_t{500} << 20);
  expect_error(import_curves(file), file, "");
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  EXPECT_LT(children.ru_maxrss, 2L << 20);  // [kB]
}

TEST(HostileFile, TheMemoryLimitIsAnError) {
  if (!can_limit_memory()) GTEST_SKIP() << "built with the address sanitizer";
  const ImportReport report =
      import_curves(corpus_file("parastell-magnet.step"), {.memory_limit_bytes = 1 << 20});
  EXPECT_FALSE(report.ok());
  EXPECT_TRUE(report.curves.empty());
}

TEST(HostileFile, AGoodFileIsReadAfterManyBadOnes) {
  const ScratchDirectory scratch;
  const std::string whole = content_of(corpus_file("igesio-sample-curves.igs"));
  for (int i = 0; i < 10; ++i) import_curves(scratch.file("bad.igs", whole.substr(0, 1000 + 200 * i)));
  EXPECT_EQ(import_curves(corpus_file("igesio-sample-curves.igs")).curves.size(), 10U);
}

}  // namespace
}  // namespace nurbeam
