#include "pipelines/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace nurbeam {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const Progress::Clock::time_point start{};

TEST(Progress, PlainLinesComeAtEveryTenthWithTimeToGoAndSpeed) {
  std::ostringstream out;
  Progress progress(out, Progress::Style::lines, 0, 2, start);
  for (int i = 1; i <= 200; ++i) {
    progress.update(0.01 * i, start + milliseconds(100 * i));
  }
  progress.finish();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_EQ(text.substr(0, text.find('\n')), " 10 %  t = 0.2 of 2 s  18 s to go  0.1 simulated s/s");
  EXPECT_NE(text.find("100 %  t = 2 of 2 s  0 s to go"), std::string::npos);
}

TEST(Progress, ATerminalLineIsRewrittenAtMostTenTimesASecond) {
  std::ostringstream out;
  Progress progress(out, Progress::Style::terminal, 0, 1, start);
  for (int i = 1; i <= 1000; ++i) {
    progress.update(1e-3 * i, start + milliseconds(i));
  }
  progress.finish();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 10);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

TEST(Progress, LongWaitsAreToldInHoursAndMinutes) {
  std::ostringstream out;
  Progress progress(out, Progress::Style::lines, 0, 1, start);
  progress.update(0.1, start + seconds(1000));
  EXPECT_NE(out.str().find("2 h 30 min to go"), std::string::npos) << out.str();
}

TEST(Progress, QuietMeansQuiet) {
  std::ostringstream out;
  Progress progress(out, Progress::Style::quiet, 0, 1, start);
  progress.update(1, start + seconds(1));
  progress.finish();
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace nurbeam
