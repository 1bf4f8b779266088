#include "pipelines/model/mass_fields.h"

#include <string>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

MassField field_in(MassField field, const ModelFrame& frame) {
  field.rate = frame.moment_to_local(field.rate);
  field.about = frame.to_local(field.about);
  field.centre = frame.to_local(field.centre);
  if (field.radial) field.radial = frame.direction_to_local(*field.radial);
  return field;
}

void check_field(const ResolvedCase& resolved, Findings& findings) {
  const bool turns = !resolved.field->rate.isZero(0);
  const std::string key = turns ? "frame" : "gravity";
  const CaseAnalysis& analysis = resolved.analysis;
  const bool buckles = analysis.type == CaseAnalysis::Type::buckling;
  if (buckles || (analysis.has_modes() && resolved.field->attraction != 0))
    findings.error("analysis.type", std::string("looks for ") + (buckles ? "buckling" : "modes") +
                                        ", which is not known " +
                                        (turns ? "in a frame that turns" : "near a point that attracts") +
                                        "; leave \"" + key + "\" out, or run a motion");
  else if (analysis.has_modes() && !analysis.modes.about_equilibrium)
    findings.error("analysis.modes.about",
                   "is \"drawn\", without what acts in the frame that turns; use \"equilibrium\"");
  for (const CaseBeam& beam : resolved.beams)
    if (beam.torsion)
      findings.error(beam.path + ".torsion",
                     "is true, but the sections of a beam with torsion do not feel \"" + key +
                         "\"; give \"torsion\": false, or leave \"" + key + "\" out");
  for (const CaseBody& body : resolved.bodies)
    if (body.inertia && resolved.field->attraction != 0)
      findings.error(body.path + ".inertia",
                     "makes a rigid body, whose turning does not feel a point that attracts; tell all in a "
                     "\"frame\" that goes round with it and has a \"gravity_gradient\"");
  constexpr double far = 1e6;  // [m]
  if (!turns && resolved.field->centre.norm() > far)
    findings.warn("gravity.centre", "is " + text_of(resolved.field->centre.norm(), 3) +
                                        " m away: positions lose so many digits that strains are round-off; "
                                        "tell all in a \"frame\" that goes round with it");
}

}  // namespace

std::optional<MassField> mass_field(const ResolvedCase& resolved, const ModelFrame& frame,
                                    Findings& findings) {
  if (!resolved.field) return {};
  check_field(resolved, findings);
  return field_in(*resolved.field, frame);
}

}  // namespace nurbeam
