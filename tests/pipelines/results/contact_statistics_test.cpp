#include "pipelines/results/contact_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nurbeam::contact_statistics_test {
namespace {

// NumPy: mean, std, min, max, quantile and histogram(f, 20) of the same numbers.
TEST(ContactStatistics, AreThoseOfNumPy) {
  std::vector<double> forces;
  for (int i = 0; i < 1000; ++i) forces.push_back(100 + 30 * std::sin(0.01 * i) + 0.02 * i);
  const ForceStatistics found = statistics_of(forces);
  EXPECT_NEAR(found.mean, 115.51532892702785, 1e-10);
  EXPECT_NEAR(found.deviation, 20.40147182611826, 1e-10);
  EXPECT_NEAR(found.least, 79.35836683723362, 1e-12);
  EXPECT_NEAR(found.greatest, 145.77464737159224, 1e-12);
  EXPECT_NEAR(found.quantile_1, 79.40217194925616, 1e-10);
  EXPECT_NEAR(found.quantile_99, 145.73617297345749, 1e-10);
  EXPECT_EQ(found.histogram, (std::vector<int>{95, 40, 33, 28, 26, 24, 32, 42, 46, 46,
                                               45, 49, 50, 54, 63, 87, 72, 32, 41, 95}));
}

constexpr double step = 1e-3, speed = 50;

// 100 N and two tones, of which the filter leaves the slow one, at 50 m/s from 0 on, for 10 s.
std::vector<ContactSample> two_tones() {
  std::vector<ContactSample> series;
  for (int i = 0; i <= 10000; ++i) {
    const double t = step * i;
    series.push_back(
        {t, speed * t,
         100 + 20 * std::sin(2 * std::numbers::pi * 2 * t) + 10 * std::sin(2 * std::numbers::pi * 80 * t)});
  }
  return series;
}

// In a window of whole periods a tone of amplitude a has the deviation a/sqrt(2).
TEST(ContactStatistics, CountInTheWindowWhatTheFilterLeaves) {
  const ContactStatistics found = contact_statistics(
      two_tones(), {.from = 100, .to = 299.99, .filter = 20, .bands = {{0, 5}, {40, 160}}});
  EXPECT_EQ(found.samples, 4000);
  EXPECT_NEAR(found.start, 2, 1e-9);
  EXPECT_NEAR(found.end, 5.999, 1e-9);
  EXPECT_NEAR(found.unfiltered.mean, 100, 1e-6);
  EXPECT_NEAR(found.unfiltered.deviation, std::sqrt(250), 1e-6);
  EXPECT_NEAR(found.filtered.mean, 100, 1e-6);
  EXPECT_NEAR(found.filtered.deviation, 20 / std::sqrt(2), 1e-4);
  EXPECT_NEAR(found.filtered.greatest, 120, 1e-3);
  ASSERT_EQ(found.bands.size(), 2u);
  EXPECT_NEAR(found.bands[0].deviation, 20 / std::sqrt(2), 0.01);
  EXPECT_NEAR(found.bands[1].deviation, 10 / std::sqrt(2), 0.01);
  EXPECT_NEAR(found.bands[1].mean, 0, 1e-4);
  EXPECT_EQ(found.losses, 0);
  EXPECT_EQ(found.missing_before, 0);
  EXPECT_EQ(found.missing_after, 0);
}

TEST(ContactStatistics, SayHowMuchLongerTheRunWouldHaveToBe) {
  const ContactStatistics found =
      contact_statistics(two_tones(), {.from = 1, .to = 499, .filter = 20, .bands = {{0, 5}}});
  EXPECT_NEAR(found.missing_before, 0.18, 1e-9);
  EXPECT_NEAR(found.missing_after, 0.18, 1e-9);
  EXPECT_EQ(contact_statistics(two_tones(), {.from = 600, .to = 700}).samples, 0);
}

// A force that is cut off at 0 for 3 and for 2 of 20 samples.
TEST(ContactStatistics, CountTheLossesOfContact) {
  std::vector<ContactSample> series;
  for (int i = 0; i < 20; ++i) series.push_back({0.01 * i, 1.0 * i, 50});
  for (const std::size_t i : {4, 5, 6, 12, 13}) series[i].force = 0;
  const ContactStatistics found = contact_statistics(series, {});
  EXPECT_EQ(found.samples, 20);
  EXPECT_EQ(found.losses, 2);
  EXPECT_NEAR(found.lost_part, 0.25, 1e-12);
  EXPECT_NEAR(found.longest_loss, 0.03, 1e-12);
}

// Steps that an event has cut do not weigh more than others.
TEST(ContactStatistics, TakeUnevenTimesAsTheyAre) {
  std::vector<ContactSample> uneven;
  for (const ContactSample& sample : two_tones()) {
    uneven.push_back(sample);
    if (sample.time < 3 || sample.time > 4) continue;
    const double t = sample.time + 0.3 * step;
    uneven.push_back(
        {t, speed * t,
         100 + 20 * std::sin(2 * std::numbers::pi * 2 * t) + 10 * std::sin(2 * std::numbers::pi * 80 * t)});
  }
  const ContactStatistics found = contact_statistics(uneven, {.from = 100, .to = 300, .filter = 20});
  EXPECT_NEAR(found.filtered.mean, 100, 0.02);
  EXPECT_NEAR(found.filtered.deviation, 20 / std::sqrt(2), 0.02);
}

}  // namespace
}  // namespace nurbeam::contact_statistics_test
