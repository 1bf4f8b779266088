#include "pipelines/run/moment_text.h"

#include "nurbs/number_text.h"

namespace nurbeam {

std::string moment_text(const CaseAnalysis& analysis, double time, int digits) {
  if (analysis.type == CaseAnalysis::Type::dynamic) return "t = " + text_of(time, digits) + " s";
  return analysis.factors().size() > 1 ? "load factor " + text_of(time, digits) : "";
}

std::string at_moment(const CaseAnalysis& analysis, double time, int digits) {
  const std::string moment = moment_text(analysis, time, digits);
  return moment.empty() ? "" : " at " + moment;
}

}  // namespace nurbeam
