#include "cad_import/occt/bar_joints.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "cad_import/report/length_unit.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

/// z of two centre lines where they come nearest to each other.
struct Crossing {
  double here, there;
};

/// Nothing where the lines pass each other, or are parallel.
std::optional<Crossing> crossing_of(const HollowBar& a, const HollowBar& b) {
  constexpr double meets_within = 1e-3;  // of the smaller size
  const Eigen::Vector3d u = a.axes.col(2), v = b.axes.col(2), gap = b.place(0) - a.place(0);
  const double along = u.dot(v), determinant = 1 - along * along;
  if (determinant <= 1e-6) return std::nullopt;
  const Crossing at{(gap.dot(u) - along * gap.dot(v)) / determinant,
                    (along * gap.dot(u) - gap.dot(v)) / determinant};
  if ((a.place(at.here) - b.place(at.there)).norm() > meets_within * std::min(a.size(), b.size()))
    return std::nullopt;
  return at;
}

double middle_of(const HollowBar::End& end) { return end.cut.value_or((end.low + end.high) / 2); }

/// Whether the place is inside the outline of the bar, continued, or so near to it that it touches.
bool touches(const HollowBar& bar, const Eigen::Vector3d& place) {
  constexpr double near = 2e-3;  // of the size
  const Eigen::Vector2d in_section = (bar.axes.transpose() * place).head<2>(),
                        inwards = bar.centre - in_section;
  const double step = std::min(near * bar.size(), inwards.norm());
  return bar.outline.surrounds(in_section + step * inwards.stableNormalized());
}

class BarJoints {
 public:
  explicit BarJoints(const std::vector<HollowBar>& bars) : bars_(bars), breaks_(bars.size()) {
    for (std::size_t i = 0; i < bars.size(); ++i) breaks_[i] = {place_of_end(i, 0), place_of_end(i, 1)};
    for (const auto& [bar, place] : branches_) divide(bar, place);
  }

  JoinedBars joined() const {
    JoinedBars joined{{}, remarks_};
    for (std::size_t i = 0; i < bars_.size(); ++i)
      for (std::size_t k = 0; k + 1 < breaks_[i].size(); ++k)
        if (breaks_[i][k + 1] > breaks_[i][k])
          joined.lines.push_back({bars_[i].place(breaks_[i][k]), bars_[i].place(breaks_[i][k + 1]),
                                  bars_[i].section, bars_[i].face});
    return joined;
  }

 private:
  double place_of_end(std::size_t i, std::size_t which) {
    const HollowBar& bar = bars_[i];
    const HollowBar::End& end = bar.ends[which];
    const double middle = middle_of(end);
    std::optional<std::pair<std::size_t, Crossing>> on;
    for (std::size_t k = 0; k < bars_.size(); ++k) {
      if (k == i) continue;
      const std::optional<Crossing> at = crossing_of(bar, bars_[k]);
      if (at && ends_on(bar, end, *at, bars_[k]) &&
          (!on || std::abs(at->here - middle) < std::abs(on->second.here - middle)))
        on = {k, *at};
    }
    if (on) {
      branches_.emplace_back(on->first, on->second.there);
      return on->second.here;
    }
    if (!end.cut) tell_of_middle(bar, end);
    return middle;
  }

  /// Whether the bar ends on or in the other, at its length or a little beyond: it touches it, or runs into
  /// it with a part of its sides.
  static bool ends_on(const HollowBar& bar, const HollowBar::End& end, const Crossing& at,
                      const HollowBar& other) {
    const double reach = 2 * other.size(), beyond = bar.size(), square = 1e-3 * bar.size();
    const bool among_corners =
        end.high - end.low > square && at.here >= end.low - square && at.here <= end.high + square;
    const bool meets = among_corners || (std::abs(at.here - middle_of(end)) <= reach &&
                                         touches(other, bar.place(middle_of(end))));
    return meets && at.there >= other.ends[0].low - beyond && at.there <= other.ends[1].high + beyond;
  }

  void tell_of_middle(const HollowBar& bar, const HollowBar::End& end) {
    remarks_.push_back("face " + std::to_string(bar.face) + ": the hollow bar of " +
                       text_of(bar.section.width) + " by " + text_of(bar.section.height) +
                       " m is cut neither by a plane nor on the centre line of another bar at " +
                       text_of(Eigen::Vector3d(bar.place(middle_of(end)) * metres_per_millimetre)) +
                       "; its centre line ends midway of the cut, up to " +
                       text_of((end.high - end.low) / 2 * metres_per_millimetre, 3) +
                       " m from where it may be meant to end");
  }

  void divide(std::size_t bar, double place) {
    std::vector<double>& breaks = breaks_[bar];
    const double together = 1e-3 * bars_[bar].size();
    if (place <= breaks.front() + together || place >= breaks.back() - together) return;
    const auto after = std::upper_bound(breaks.begin(), breaks.end(), place);
    if (place - *(after - 1) > together && *after - place > together) breaks.insert(after, place);
  }

  const std::vector<HollowBar>& bars_;
  std::vector<std::vector<double>> breaks_;  // of each bar, ascending
  std::vector<std::pair<std::size_t, double>> branches_;
  std::vector<std::string> remarks_;
};

}  // namespace

JoinedBars joined_bars(const std::vector<HollowBar>& bars) { return BarJoints(bars).joined(); }

}  // namespace nurbeam
