#pragma once
#include <optional>

#include "pipelines/case/case_file.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/cad_files.h"
#include "pipelines/section/section_profile.h"

namespace nurbeam {

/// The numbers of a section, and the profile that they come from where it is drawn.
struct BeamSection {
  CaseSection section;
  std::optional<SectionProfile> profile = {};
};

/// The section of a beam in a model of so many dimensions; nothing, with an error among the findings, where
/// the profile cannot be used.
std::optional<BeamSection> beam_section(const CaseBeam& beam, int dimension, CadFiles& files,
                                        Findings& findings);

/// Stiffness and inertia of the sections of a beam with torsion; nothing, with an error among the findings,
/// where its torsion constant is not known. Profiles: the x axis is d1, the y axis d2.
std::optional<SectionStiffness> section_stiffness(const CaseBeam& beam, const BeamSection& section,
                                                  Findings& findings);

}  // namespace nurbeam
