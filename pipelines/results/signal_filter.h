#pragma once
#include <span>
#include <vector>

namespace nurbeam {

/// One section of a digital filter, y = (b0 + b1/z + b2/z^2)/(1 + a1/z + a2/z^2) x.
struct FilterSection {
  double b0, b1, b2, a1, a2;
};

/// A Butterworth low-pass filter of an even order for samples at a rate [Hz], by the bilinear transform with
/// its frequency [Hz] kept, 0 < frequency < rate/2.
std::vector<FilterSection> butterworth_low_pass(int order, double frequency, double rate);
/// A band-pass filter made of that low-pass filter, 0 < low < high < rate/2 [Hz].
std::vector<FilterSection> butterworth_band_pass(int order, double low, double high, double rate);

/// The signal, filtered forwards and then backwards, so that nothing is delayed. Each way begins in the
/// steady state of its first value. Before and after, the signal goes on as its reflection in its end, for
/// three samples for each coefficient.
std::vector<double> filtered_both_ways(const std::vector<FilterSection>& filter,
                                       std::span<const double> signal);

}  // namespace nurbeam
