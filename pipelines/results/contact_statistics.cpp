#include "pipelines/results/contact_statistics.h"

#include <algorithm>
#include <cmath>

#include "pipelines/results/signal_filter.h"

namespace nurbeam {

namespace {

constexpr int filter_order = 4, histogram_parts = 20;

double quantile(const std::vector<double>& sorted, double part) {
  const double at = part * static_cast<double>(sorted.size() - 1);
  const auto before = static_cast<std::size_t>(at), after = std::min(before + 1, sorted.size() - 1);
  return sorted[before] + (at - static_cast<double>(before)) * (sorted[after] - sorted[before]);
}

// The series at even times.
std::vector<ContactSample> even(const std::vector<ContactSample>& series) {
  const std::size_t n = series.size();
  const double start = series.front().time, step = (series.back().time - start) / static_cast<double>(n - 1);
  std::vector<ContactSample> result;
  result.reserve(n);
  std::size_t next = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = start + step * static_cast<double>(i);
    while (next + 1 < n && series[next].time < t) ++next;
    const ContactSample &a = series[next - 1], &b = series[next];
    const double part = std::clamp((t - a.time) / (b.time - a.time), 0.0, 1.0);
    result.push_back({t, a.place + part * (b.place - a.place), a.force + part * (b.force - a.force)});
  }
  return result;
}

// The filter that leaves these frequencies; none where it leaves all.
std::vector<FilterSection> filter_of(double low, double high, double rate) {
  const bool cuts_high = high < rate / 2;
  if (low <= 0)
    return cuts_high ? butterworth_low_pass(filter_order, high, rate) : std::vector<FilterSection>{};
  constexpr double nearly = 0.999;
  return butterworth_band_pass(filter_order, low, cuts_high ? high : nearly * rate / 2, rate);
}

struct Window {
  std::size_t first, count;

  std::vector<double> of(const std::vector<double>& values) const {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
  }
};

// Times without contact.
void count_losses(const std::vector<double>& forces, double step, ContactStatistics& found) {
  int lost = 0, now = 0, longest = 0;
  for (const double force : forces) {
    const bool is_lost = force <= 0;
    if (is_lost && now == 0) ++found.losses;
    now = is_lost ? now + 1 : 0;
    lost += is_lost ? 1 : 0;
    longest = std::max(longest, now);
  }
  found.lost_part = static_cast<double>(lost) / static_cast<double>(forces.size());
  found.longest_loss = longest * step;
}

}  // namespace

ForceStatistics statistics_of(const std::vector<double>& forces) {
  ForceStatistics found;
  const auto n = static_cast<double>(forces.size());
  for (const double force : forces) found.mean += force / n;
  double squares = 0;
  for (const double force : forces) squares += (force - found.mean) * (force - found.mean);
  found.deviation = std::sqrt(squares / n);
  std::vector<double> sorted = forces;
  std::ranges::sort(sorted);
  found.least = sorted.front();
  found.greatest = sorted.back();
  found.quantile_1 = quantile(sorted, 0.01);
  found.quantile_99 = quantile(sorted, 0.99);
  found.histogram.assign(histogram_parts, 0);
  const double width = (found.greatest - found.least) / histogram_parts;
  for (const double force : forces) {
    const int part = width > 0 ? static_cast<int>((force - found.least) / width) : 0;
    ++found.histogram[static_cast<std::size_t>(std::min(part, histogram_parts - 1))];
  }
  return found;
}

ContactStatistics contact_statistics(const std::vector<ContactSample>& series, const ContactWindow& window) {
  ContactStatistics found;
  if (series.size() < 2) return found;
  const std::vector<ContactSample> samples = even(series);
  const auto inside = [&](const ContactSample& s) { return s.place >= window.from && s.place <= window.to; };
  const auto first = std::ranges::find_if(samples, inside),
             last = std::find_if_not(first, samples.end(), inside);
  if (first == last) return found;
  const Window in{static_cast<std::size_t>(first - samples.begin()), static_cast<std::size_t>(last - first)};
  found.samples = static_cast<int>(in.count);
  found.start = first->time;
  found.end = (last - 1)->time;

  std::vector<double> force;
  for (const ContactSample& sample : samples) force.push_back(sample.force);
  const double step = samples[1].time - samples[0].time;
  found.unfiltered = statistics_of(in.of(force));
  count_losses(in.of(force), step, found);
  double slowest = window.filter;
  const auto between = [&](double low, double high) {
    ForceStatistics statistics =
        statistics_of(in.of(filtered_both_ways(filter_of(low, high, 1 / step), force)));
    statistics.low = low;
    statistics.high = high;
    slowest = std::min(slowest, low > 0 ? low : high);
    return statistics;
  };
  found.filtered = between(0, window.filter);
  for (const auto& [low, high] : window.bands) found.bands.push_back(between(low, high));
  const double needed = 1 / slowest;
  found.missing_before = std::max(0.0, needed - (found.start - samples.front().time));
  found.missing_after = std::max(0.0, needed - (samples.back().time - found.end));
  return found;
}

}  // namespace nurbeam
