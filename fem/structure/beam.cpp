#include "fem/structure/beam.h"

#include <algorithm>
#include <cmath>

namespace nurbeam {

namespace {

/// floor(h / n) for n > 0.
int turns_of(int h, int n) { return (h >= 0 ? h : h - n + 1) / n; }

}  // namespace

const PipeBend* Beam::bend_at(double s) const {
  if (bends.empty()) return nullptr;
  const int segment = curve.segment_at(s);
  for (const PipeBend& bend : bends)
    if (bend.segment == segment) return &bend;
  return nullptr;
}

const BeamProperties& Beam::properties_at(double s) const {
  const PipeBend* bend = bend_at(s);
  return bend ? bend->properties : properties;
}

int Beam::home_index(int h) const {
  return is_ring() ? h - home_intervals() * turns_of(h, home_intervals()) : h;
}

double Beam::home_place(int h) const {
  return home[home_index(h)].s + (is_ring() ? curve.length() * turns_of(h, home_intervals()) : 0);
}

int Beam::home_interval(double s) const {
  const double at = curve.wrapped(s);
  const auto above = std::upper_bound(home.begin() + 1, home.end() - 1, at,
                                      [](double place, const HomeNode& node) { return place < node.s; });
  const int h = static_cast<int>(above - home.begin()) - 1;
  return h + home_intervals() * static_cast<int>(std::round((s - at) / curve.length()));
}

double Beam::home_spacing(double s) const {
  const int h = home_interval(s);
  return home_place(h + 1) - home_place(h);
}

int Beam::home_at(double s) const {
  const double same = 1e-9 * curve.length();
  for (int h = 0; h < static_cast<int>(home.size()); ++h)
    if (std::abs(home[h].s - s) <= same) return home_index(h);
  return -1;
}

}  // namespace nurbeam
