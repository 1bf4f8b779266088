#pragma once
#include <string>
#include <vector>

#include "nurbs/bezier_path.h"
#include "pipelines/case/case_file.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/cad_files.h"

namespace nurbeam {

/// A case in which each beam has one chain of curves.
struct BeamChains {
  CaseFile case_file;
  std::vector<Chain> chains;  ///< per beam: indices into the curves of its file; empty for other axes
};

/// Chooses the curves of the axes that are in files. A beam of several chains becomes one beam for each,
/// named "name 1", "name 2", ...; what was said of the beam is said of each of them. A section "from" a CAD
/// file becomes that of the pipe. With errors among the findings the result cannot be used.
BeamChains choose_chains(CaseFile case_file, CadFiles& files, Findings& findings);

/// The number of the beam of that name, which the case has.
int beam_index(const CaseFile& case_file, const std::string& name);
/// How many bodies slide on the beam of that name.
int sliding_bodies(const CaseFile& case_file, const std::string& name);

}  // namespace nurbeam
