#pragma once
#include "pipelines/case/fields.h"

namespace nurbeam {

struct CaseProbe {
  std::string name, beam;
  std::string path;
  Place at;
};

inline Fields<CaseProbe> probe_fields() {
  using namespace shapes;
  using P = CaseProbe;
  return {{
      field(&P::name, "name", name(), "heads the columns of the probe").needed(),
      field(&P::beam, "beam", name(), "the probed beam").needed(),
      field(&P::at, "at", place(), "where").needed(),
  }};
}

}  // namespace nurbeam
