#pragma once
#include "pipelines/case/fields.h"
#include "pipelines/case/limits.h"

namespace nurbeam {

/// Where a tolerance holds: in the static state in which the analysis starts, or at all output times.
enum class ToleranceOver { start, motion };

struct CaseElements {
  std::optional<int> count;
  std::optional<double> max_length;  ///< [m]
  std::optional<int> per_segment;
  std::optional<double> tolerance;  ///< error of positions over the length (adapt_mesh)
  ToleranceOver over = ToleranceOver::start;
  double grading = 0;  ///< increment of length between neighbouring elements of one segment [m]
};

inline Fields<CaseElements> elements_fields() {
  using namespace shapes;
  using E = CaseElements;
  const Range count{.lower = 1, .upper = most_elements, .reason = "the most elements of one beam"};
  const Range tolerance{.lower = 1e-9, .upper = 0.1, .reason = "less is round-off, more no longer a measure"};
  return {
      {
          field(
              &E::count, "count", integer(count),
              "number of elements of the beam; 20, or one a segment if there are more segments, when omitted"),
          field(&E::max_length, "max_length", quantity(Dimension::length, positive()),
                "maximum length of an element"),
          field(&E::per_segment, "per_segment", integer(count),
                "elements per cubic segment of the axis, cut at the supports"),
          field(&E::tolerance, "tolerance", quantity(Dimension::number, tolerance),
                "error of positions over the length of the beam, for which as many elements are made as "
                "needed; estimated in the static state with bodies locked at their start"),
          choice_field(
              &E::over, "over", {{"start", ToleranceOver::start}, {"motion", ToleranceOver::motion}},
              "where the tolerance applies; motion: to the whole motion, by runs with twice the elements "
              "each, in \"nurbeam run\" and Python")
              .otherwise("start")
              .beside("tolerance"),
          field(&E::grading, "grading", quantity(Dimension::length),
                "how much longer each element is than the one before it in its segment; negative: shorter")
              .beside("per_segment"),
      },
      {{{"count", "max_length", "per_segment", "tolerance"}, false}}};
}

}  // namespace nurbeam
