#include "pipelines/model/why_torsion.h"

namespace nurbeam {

std::string why_torsion(const CaseBeam& beam, const TorsionReasons& reasons) {
  const auto& [asked, uneven, curved, moment, turned] = reasons;
  if (asked) return "yes, as the case asks for it";
  if (uneven) return "yes, as its section does not bend alike in all directions";
  if (beam.torsion && curved) return "yes, as it is drawn curved in space and free of stress so";
  if (beam.torsion && moment) return "yes, as a moment on it has a part along it where it bends";
  if (beam.torsion && turned) return "yes, as what holds it turns its sections";
  if (beam.torsion) return "yes, as what a corner or a joint holds at an angle in space would turn about it";
  if (!beam.torsion_by_drawing) return "no, as the case asks for an element without it";
  return "no, as it is drawn straight and bends alike in all directions";
}

}  // namespace nurbeam
