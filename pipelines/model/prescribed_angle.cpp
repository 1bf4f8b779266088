#include "pipelines/model/prescribed_angle.h"

namespace nurbeam {

AngleMotion prescribed_angle(const CaseRotation& from, const CaseAnalysis& analysis, Findings& findings) {
  const bool moves = analysis.type == CaseAnalysis::Type::dynamic;  // else it grows with the load factor
  if (from.speed && !moves)
    findings.error(from.path + ".speed",
                   "is of a motion, and nothing moves here; give a \"table\" of angles");
  return from.speed ? AngleMotion::at_speed(*from.speed, from.ramp)
                    : AngleMotion(from.table, moves ? from.join : RowJoin::linear);
}

bool starts_as_drawn(const CaseAnalysis& analysis) {
  return analysis.type == CaseAnalysis::Type::dynamic && !analysis.start_from_equilibrium;
}

}  // namespace nurbeam
