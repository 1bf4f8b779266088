#pragma once
#include <optional>

#include "fem/material/section_stresses.h"
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
/// the profile cannot be used. A profile that does not bend alike in all directions has both its second
/// moments in space, where the beam does not say that it has no torsion.
std::optional<BeamSection> beam_section(const CaseBeam& beam, int dimension, CadFiles& files,
                                        Findings& findings);

/// What the sections of a beam with torsion have besides.
struct TorsionSection {
  SectionStiffness stiffness;
  std::optional<SectionStresses> stresses = {};  ///< where the outline is known, or an extreme fibre
};
/// Nothing, with an error among the findings, where the torsion constant is not known. Profiles: the x axis
/// is d1, the y axis d2. Warns where the drawn section of a beam of that length [m] does what the element
/// does not know: a shear centre off the centroid, and warping that clamps hold.
std::optional<TorsionSection> torsion_section(const CaseBeam& beam, double length, const BeamSection& section,
                                              Findings& findings);

}  // namespace nurbeam
