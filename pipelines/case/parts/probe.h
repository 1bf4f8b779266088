#pragma once
#include "fem/motion/record/snapshot.h"
#include "pipelines/case/fields.h"

namespace nurbeam {

struct CaseProbe {
  std::string name, beam;
  std::string path;
  Place at;
  ProbePlace::Side side = ProbePlace::Side::after;
};

inline Fields<CaseProbe> probe_fields() {
  using namespace shapes;
  using P = CaseProbe;
  return {{
      field(&P::name, "name", name(), "heads the columns of the probe").needed(),
      field(&P::beam, "beam", name(), "the probed beam").needed(),
      field(&P::at, "at", place(), "where").needed(),
      choice_field(&P::side, "side",
                   {{"before", ProbePlace::Side::before}, {"after", ProbePlace::Side::after}},
                   "where forces jump at the position: the side of smaller or of larger s")
          .otherwise("after"),
  }};
}

}  // namespace nurbeam
