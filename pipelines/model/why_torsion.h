#pragma once
#include <string>

#include "pipelines/case/case_file.h"

namespace nurbeam {

/// Whether a beam in space has torsion, which its `torsion` says by now, and why: for those who check a case.
/// `asked`: the case file itself asks for it; `uneven`: its section bends about two axes of its own;
/// `curved`: it is drawn so.
std::string why_torsion(const CaseBeam& beam, bool asked, bool uneven, bool curved);

}  // namespace nurbeam
