#include "pipelines/results/signal_filter.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace nurbeam {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

// The poles of the low-pass filter of angular frequency 1 that lie above the real axis.
std::vector<Complex> upper_poles(int order) {
  std::vector<Complex> poles;
  for (int k = 0; k < order / 2; ++k)
    poles.push_back(std::polar(1.0, pi / 2 + pi * (2 * k + 1) / (2 * order)));
  return poles;
}

// The angular frequency that the bilinear transform maps to this one.
double warped(double frequency, double rate) { return 2 * rate * std::tan(pi * frequency / rate); }

// A pole and its conjugate in z, with zeros of z given by b1 and b2.
FilterSection section_of(Complex pole, double rate, double b1, double b2) {
  const Complex z = (2 * rate + pole) / (2 * rate - pole);
  return {1, b1, b2, -2 * z.real(), std::norm(z)};
}

void scale(FilterSection& section, double factor) {
  section.b0 *= factor;
  section.b1 *= factor;
  section.b2 *= factor;
}

double gain(const FilterSection& f, Complex z) {
  return std::abs((f.b0 + f.b1 / z + f.b2 / (z * z)) / (1.0 + f.a1 / z + f.a2 / (z * z)));
}

// One way, begun in the steady state of the first value.
void run_through(const FilterSection& f, std::vector<double>& signal, double first) {
  const double steady = first * (f.b0 + f.b1 + f.b2) / (1 + f.a1 + f.a2);
  double second = f.b2 * first - f.a2 * steady, one = f.b1 * first - f.a1 * steady + second;
  for (double& value : signal) {
    const double x = value;
    value = f.b0 * x + one;
    one = f.b1 * x - f.a1 * value + second;
    second = f.b2 * x - f.a2 * value;
  }
}

void run_through(const std::vector<FilterSection>& filter, std::vector<double>& signal) {
  double first = signal.front();
  for (const FilterSection& section : filter) {
    run_through(section, signal, first);
    first *= (section.b0 + section.b1 + section.b2) / (1 + section.a1 + section.a2);
  }
}

}  // namespace

std::vector<FilterSection> butterworth_low_pass(int order, double frequency, double rate) {
  std::vector<FilterSection> filter;
  for (const Complex pole : upper_poles(order)) {
    FilterSection& section = filter.emplace_back(section_of(warped(frequency, rate) * pole, rate, 2, 1));
    scale(section, 1 / gain(section, 1));
  }
  return filter;
}

// s of the low-pass filter becomes (s^2 + w0^2)/(B s).
std::vector<FilterSection> butterworth_band_pass(int order, double low, double high, double rate) {
  const double w1 = warped(low, rate), w2 = warped(high, rate), width = w2 - w1, middle = std::sqrt(w1 * w2);
  const Complex centre = std::polar(1.0, 2 * std::atan(middle / (2 * rate)));
  std::vector<FilterSection> filter;
  for (const Complex pole : upper_poles(order)) {
    const Complex half = pole * width / 2.0, root = std::sqrt(half * half - middle * middle);
    for (const Complex s : {half + root, half - root}) {
      FilterSection& section = filter.emplace_back(section_of(s, rate, 0, -1));
      scale(section, 1 / gain(section, centre));
    }
  }
  return filter;
}

std::vector<double> filtered_both_ways(const std::vector<FilterSection>& filter,
                                       std::span<const double> signal) {
  if (signal.size() < 2 || filter.empty()) return {signal.begin(), signal.end()};
  const std::size_t beyond = std::min(3 * (2 * filter.size() + 1), signal.size() - 1), n = signal.size();
  std::vector<double> longer;
  longer.reserve(n + 2 * beyond);
  for (std::size_t i = beyond; i > 0; --i) longer.push_back(2 * signal[0] - signal[i]);
  longer.insert(longer.end(), signal.begin(), signal.end());
  for (std::size_t i = 1; i <= beyond; ++i) longer.push_back(2 * signal[n - 1] - signal[n - 1 - i]);
  for (int way = 0; way < 2; ++way) {
    run_through(filter, longer);
    std::ranges::reverse(longer);
  }
  const auto first = longer.begin() + static_cast<std::ptrdiff_t>(beyond);
  return {first, first + static_cast<std::ptrdiff_t>(n)};
}

}  // namespace nurbeam
