#include "fem/structure/carried_body.h"

#include "fem/structure/structure.h"

namespace nurbeam {

std::string CarriedBody::reaction_name(const Structure& structure) const {
  return structure.bodies[body].name;
}

}  // namespace nurbeam
