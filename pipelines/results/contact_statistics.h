#pragma once
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace nurbeam {

/// A contact force at one time.
struct ContactSample {
  double time;   ///< [s]
  double place;  ///< along the travel [m]
  double force;  ///< [N]
};

/// Of a force while its collector is in the window.
struct ForceStatistics {
  double low = 0, high = std::numeric_limits<double>::infinity();  ///< frequencies that it has [Hz]
  double mean = 0, deviation = 0;          ///< [N]; the root of the mean square distance from the mean
  double least = 0, greatest = 0;          ///< [N]
  double quantile_1 = 0, quantile_99 = 0;  ///< below which 1 % and 99 % of the samples are [N]
  std::vector<int> histogram = {};         ///< samples in parts of equal width from the least to the greatest
};

/// What is evaluated.
struct ContactWindow {
  double from = -std::numeric_limits<double>::infinity();  ///< [m]
  double to = std::numeric_limits<double>::infinity();     ///< [m]
  double filter = 20;                                      ///< [Hz]
  std::vector<std::pair<double, double>> bands = {};       ///< [Hz]
};

struct ContactStatistics {
  int samples = 0;            ///< in the window
  double start = 0, end = 0;  ///< times of the first and the last of them [s]
  ForceStatistics unfiltered, filtered;
  std::vector<ForceStatistics> bands = {};
  double lost_part = 0;     ///< of the time, with a force of 0
  int losses = 0;           ///< how often contact was lost
  double longest_loss = 0;  ///< [s]
  /// How much longer the run would have to be before and after the window for the filters to be in their
  /// steady state there [s]; 0: long enough.
  double missing_before = 0, missing_after = 0;
};

/// The largest displacement of a probe along the direction in which a collector presses, since the start.
struct Uplift {
  std::string probe;
  double value = 0;  ///< [m]
  double time = 0;   ///< [s]
};

/// What is told of a collector after a run.
struct CollectorOutcome {
  std::string name;
  double from, to;  ///< of the window [m]
  ContactStatistics contact;
  std::vector<Uplift> uplift;
};

/// Mean, deviation, extremes, quantiles (interpolated between samples) and a histogram of 20 parts.
ForceStatistics statistics_of(const std::vector<double>& forces);

/// Statistics of a series, time increasing, while the place is in the window. Filters are of order 4,
/// forwards and backwards over the whole series, which is interpolated where its times are uneven.
/// Frequencies that the sampling does not have are left out of filters.
ContactStatistics contact_statistics(const std::vector<ContactSample>& series, const ContactWindow& window);

}  // namespace nurbeam
