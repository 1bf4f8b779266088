#include "pipelines/case/force_laws.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nurbs/number_text.h"
#include "pipelines/case/case_json.h"

namespace nurbeam {

std::optional<ForceRows> force_rows(const Json& json, const std::string& path, Findings& findings) {
  std::vector<std::pair<double, double>> rows;
  take(json, rows);
  try {
    const ForceRows law(rows);
    const double range = std::max(std::abs(rows.front().second), std::abs(rows.back().second));
    if (const double force = law.at(0).force; std::abs(force) > 1e-9 * range)
      findings.error(path,
                     "has a force of " + text_of(force, 4) +
                         " N where the stretch is 0; the stretch counts from where there is no force, so a "
                         "row must be [0, 0] or the rows must pass through it");
    return law;
  } catch (const std::invalid_argument& problem) {
    findings.error(path, problem.what());
    return {};
  }
}

std::optional<AxialLaw> axial_law(const Json& json, const std::string& path, Findings& findings) {
  if (json.is_string()) return json == "hooke" ? AxialLaw(HookeLaw()) : AxialLaw(GreenLaw());
  const std::optional<ForceRows> rows = force_rows(json, path, findings);
  if (!rows) return {};
  try {
    return ForceOverStretch(rows->rows());
  } catch (const std::invalid_argument& problem) {
    findings.error(path, problem.what());
    return {};
  }
}

}  // namespace nurbeam
