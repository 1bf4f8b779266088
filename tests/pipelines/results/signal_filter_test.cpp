#include "pipelines/results/signal_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace nurbeam::signal_filter_test {
namespace {

using std::numbers::pi;

constexpr double rate = 1000;

std::vector<double> signal_of_three_tones() {
  std::vector<double> signal;
  for (int i = 0; i < 1200; ++i) {
    const double t = i / rate;
    signal.push_back(100 + 20 * std::sin(2 * pi * 3 * t) + 10 * std::sin(2 * pi * 12 * t + 1) +
                     5 * std::sin(2 * pi * 60 * t) + 8 * t * t);
  }
  return signal;
}

void expect_values(const std::vector<FilterSection>& filter, const std::vector<double>& expected) {
  const std::vector<double> filtered = filtered_both_ways(filter, signal_of_three_tones());
  std::size_t next = 0;
  for (const std::size_t i : {0, 1, 150, 600, 777, 1198, 1199})
    EXPECT_NEAR(filtered[i], expected[next++], 2e-8) << i;
}

// SciPy 1.10.1: sosfiltfilt(butter(4, frequencies, type, fs=1000, output="sos"), signal).
TEST(SignalFilter, IsThatOfSciPy) {
  expect_values(butterworth_low_pass(4, 20, rate),
                {109.01533133609692, 109.3827401235344, 103.86537102266799, 91.47075240180675,
                 123.33369325832804, 104.47932137569693, 104.2739296080751});
  expect_values(butterworth_low_pass(4, 5, rate),
                {108.40695524567785, 108.52753409819228, 106.3915407497283, 84.17803292523169,
                 122.0497119211045, 123.96939261760572, 123.96899584811327});
  expect_values(butterworth_band_pass(4, 5, 20, rate),
                {-0.39405840382183954, -0.018057332713609542, -3.097635813795528, 7.569191907449501,
                 0.8668620682120327, 0.8522807829264039, 0.7374285116376054});
}

double gain(const std::vector<FilterSection>& filter, double frequency) {
  const std::complex<double> z = std::polar(1.0, 2 * pi * frequency / rate);
  std::complex<double> product = 1;
  for (const FilterSection& f : filter)
    product *= (f.b0 + f.b1 / z + f.b2 / (z * z)) / (1.0 + f.a1 / z + f.a2 / (z * z));
  return std::abs(product);
}

// |H|^2 = 1/(1 + (w/w_c)^8) of warped frequencies: half the power passes where the filter ends.
TEST(SignalFilter, HasTheGainOfButterworth) {
  const auto warped = [](double f) { return std::tan(pi * f / rate); };
  const auto low = butterworth_low_pass(4, 20, rate);
  for (const double f : {0.0, 1.0, 10.0, 20.0, 40.0, 200.0})
    EXPECT_NEAR(gain(low, f), 1 / std::sqrt(1 + std::pow(warped(f) / warped(20), 8)), 1e-9) << f;
  const auto band = butterworth_band_pass(4, 5, 20, rate);
  for (const double f : {5.0, 20.0}) EXPECT_NEAR(gain(band, f), std::sqrt(0.5), 1e-9) << f;
  EXPECT_NEAR(gain(band, 0), 0, 1e-9);
  EXPECT_NEAR(gain(band, 10), 1, 1e-3);
}

TEST(SignalFilter, LeavesAConstantAndAShortSignal) {
  for (const double value :
       filtered_both_ways(butterworth_low_pass(4, 20, rate), std::vector<double>(50, 7.0)))
    EXPECT_NEAR(value, 7, 1e-11);
  EXPECT_EQ(filtered_both_ways(butterworth_low_pass(4, 20, rate), std::vector<double>{3}),
            std::vector<double>{3});
}

}  // namespace
}  // namespace nurbeam::signal_filter_test
