#include "pipelines/run/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace nurbeam {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const Progress::Clock::time_point start{};

StepRecord at(double time) { return {time, 0.01, 3, 0}; }

TEST(Progress, PlainLinesComeAtEveryTenthWithTimeToGoAndSpeed) {
  std::ostringstream out;
  Progress progress(out, Progress::Style::lines, 0, 2, start);
  for (int i = 1; i <= 200; ++i) progress.update(at(0.01 * i), start + milliseconds(100 * i));
  progress.finish();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            " 10 %  t = 0.2 of 2 s  18 s to go  0.1 simulated s/s  step 0.01 s, 3 Newton");
  EXPECT_NE(text.find("100 %  t = 2 of 2 s  0 s to go"), std::string::npos);
}

TEST(Progress, ATerminalLineIsRewrittenAtMostTenTimesASecond) {
  std::ostringstream out;
  Progress progress(out, Progress::Style::terminal, 0, 1, start);
  for (int i = 1; i <= 1000; ++i) progress.update(at(1e-3 * i), start + milliseconds(i));
  progress.finish();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 10);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

TEST(Progress, LongWaitsAreToldInHoursAndMinutes) {
  std::ostringstream out;
  Progress progress(out, Progress::Style::lines, 0, 1, start);
  progress.update(at(0.1), start + seconds(1000));
  EXPECT_NE(out.str().find("2 h 30 min to go"), std::string::npos) << out.str();
}

TEST(Progress, AResumedRunTellsItsSpeedAndTimeToGoFromWhereItGoesOn) {
  std::ostringstream out;
  Progress progress(out, Progress::Style::lines, 0.55, 1, start);
  progress.update(at(0.6), start + seconds(5));
  progress.update(at(0.65), start + seconds(10));
  EXPECT_EQ(out.str(), " 60 %  t = 0.6 of 1 s  40 s to go  0.01 simulated s/s  step 0.01 s, 3 Newton\n");
}

TEST(Progress, ATerminalLineFitsTheTerminal) {
  for (const std::size_t width : {20, 40, 60, 80}) {
    std::ostringstream out;
    Progress progress(out, Progress::Style::terminal, 0, 123.456789, start, width);
    progress.update(at(123.456789), start + seconds(100000));
    std::string line = out.str().substr(1);
    line.resize(line.find('\x1b'));
    EXPECT_LT(line.size(), width) << line;
    EXPECT_EQ(line.find("100 %"), 0u) << line;
  }
}

TEST(Progress, TheSearchForRestDoesNotCountForTheTimeToGo) {
  std::ostringstream out;
  Progress progress(out, Progress::Style::lines, 0, 1, start);
  progress.begin_motion(start + seconds(1000));
  progress.update(at(0.1), start + seconds(1001));
  EXPECT_NE(out.str().find("  9 s to go"), std::string::npos) << out.str();
}

TEST(Progress, QuietMeansQuiet) {
  std::ostringstream out;
  Progress progress(out, Progress::Style::quiet, 0, 1, start);
  progress.update(at(1), start + seconds(1));
  progress.finish();
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace nurbeam
