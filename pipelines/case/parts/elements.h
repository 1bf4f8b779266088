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
          field(&E::count, "count", integer(count),
                "number of elements of the beam; 20 when nothing is said, or as many as there are segments"),
          field(&E::max_length, "max_length", quantity(Dimension::length, positive()),
                "greatest element length"),
          field(&E::per_segment, "per_segment", integer(count),
                "elements per cubic segment of the axis, cut at the supports"),
          field(
              &E::tolerance, "tolerance", quantity(Dimension::number, tolerance),
              "as many elements as the beam needs for this error of positions, over its length, estimated from "
              "the static state in which bodies are held where they start"),
          choice_field(&E::over, "over", {{"start", ToleranceOver::start}, {"motion", ToleranceOver::motion}},
                       "where the tolerance holds; motion: over the whole motion, found by runs with ever "
                       "twice the elements, in \"nurbeam run\" and Python")
              .otherwise("start")
              .beside("tolerance"),
          field(&E::grading, "grading", quantity(Dimension::length),
                "how much longer each element is than the one before it in its segment; negative: shorter")
              .beside("per_segment"),
      },
      {{{"count", "max_length", "per_segment", "tolerance"}, false}}};
}

}  // namespace nurbeam
