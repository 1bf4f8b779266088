#include "pipelines/case/parts/grip.h"

#include "pipelines/case/case_json.h"

namespace nurbeam {

void take_place(const Json& value, const std::string& path, CaseGrip& grip, Findings& findings) {
  if (!grip.beam.empty())
    take(value, grip.at);
  else if (grip.body.empty())
    findings.error(path, "is where on a beam or a body; a point in space has no such place");
  else if (value.is_string())
    take(value, grip.body_point);
  else if (value.is_array())
    take(value, grip.body_place);
  else
    findings.error(path, "is a place of a beam; of a body give the name of one of its points, or [x, y, z]");
}

}  // namespace nurbeam
