#include "fem/structure/support.h"

#include "fem/structure/structure.h"
#include "nurbs/number_text.h"

namespace nurbeam {

std::string Support::reaction_name(const Structure& structure) const {
  if (!name.empty()) return name;
  const Beam& of = structure.beams[beam];
  const bool open = !of.is_ring();
  const std::string at = open && s == of.curve.start() ? ".start"
                         : open && s == of.curve.end() ? ".end"
                                                       : "@" + text_of(s);
  return "reaction." + of.name + at;
}

}  // namespace nurbeam
