#pragma once
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "pipelines/study/openturns_study.h"

namespace nurbeam {

/// Where the `constraints` of a study that are comparisons hold: variants elsewhere do not run. Places are
/// what a search makes of the free variables, so that they weigh the same.
class AllowedRegion {
 public:
  using PointOf = std::function<std::vector<double>(const std::vector<double>& place)>;

  /// Within bounds of places, where there are some.
  AllowedRegion(const StudyFile& study, PointOf point_of, std::optional<OT::Interval> bounds = {});

  bool is_whole() const { return constraints_.empty(); }
  /// Of each constraint what must be 0 or more.
  std::vector<double> margins(const std::vector<double>& place) const;
  const std::string& text(std::size_t constraint) const { return constraints_[constraint].text; }
  bool has(const std::vector<double>& place) const;
  /// The place itself where the region has it, else the nearest one that it has; nothing where none is found.
  std::optional<std::vector<double>> nearest(const std::vector<double>& place);

 private:
  std::optional<std::vector<double>> nearest_inside(const std::vector<double>& place, double margin) const;

  const StudyFile& study_;
  PointOf point_of_;
  std::optional<OT::Interval> bounds_;
  std::vector<StudyOptimum::Constraint> constraints_;
  std::map<std::vector<double>, std::optional<std::vector<double>>> found_;
};

}  // namespace nurbeam
