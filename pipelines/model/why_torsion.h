#pragma once
#include <string>

#include "pipelines/case/case_file.h"

namespace nurbeam {

/// What gives a beam in space torsion.
struct TorsionReasons {
  bool asked;   ///< by the case file itself
  bool uneven;  ///< its section bends about two axes of its own
  bool curved;  ///< as it is drawn
  bool moment;  ///< works on it
  bool turned;  ///< by a support that turns, or held by a rotational connector
};

/// Whether a beam in space has torsion, which its `torsion` says by now, and why: for those who check a case.
std::string why_torsion(const CaseBeam& beam, const TorsionReasons& reasons);

}  // namespace nurbeam
