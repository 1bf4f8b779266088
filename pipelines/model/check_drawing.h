#pragma once
#include <vector>

#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/build_model.h"
#include "pipelines/model/cad_files.h"

namespace nurbeam {

/// Warns of each beam with torsion whose drawn axis turns by more than 60 degrees within an element, with the
/// place of the one that turns most: the quadrature of parallel transport in it loses digits there. Likewise
/// where sections that bend more easily one way are drawn turning about it by more than 30 degrees: the axis
/// of an element cannot bend first the one way and then the other.
void check_turns(const std::vector<CaseBeam>& beams, const BeamModel& model, const ModelFrame& frame,
                 Findings& findings);

/// Warns of each beam whose elements, with all weights 1, are more than a millionth of its length from the
/// drawing.
void check_polynomial_elements(const std::vector<CaseBeam>& beams, const BeamModel& model,
                               const ModelFrame& frame, Findings& findings);

/// Notes what the damping of bars in space without torsion does not reach.
void mention_damping(const std::vector<CaseBeam>& beams, const BeamModel& model, Findings& findings);

/// Reports formats of CAD files that draw sections which nothing orients, as those of beams without torsion.
void check_drawn_sections(const CaseOutput& output, const std::vector<CaseBeam>& beams, Findings& findings);

/// Reports where deformed shapes are to go into their source, and the axes are not all from one STEP file.
void check_source(const CaseOutput& output, const std::vector<CaseBeam>& beams, CadFiles& files,
                  Findings& findings);

/// Warns of beams that their own weight strains by a tenth, as a modulus in a wrong unit makes them.
void check_softness(const std::vector<CaseBeam>& beams, const BeamModel& model, Findings& findings);

}  // namespace nurbeam
