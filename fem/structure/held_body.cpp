#include "fem/structure/held_body.h"

#include "fem/structure/structure.h"

namespace nurbeam {

std::string HeldBody::reaction_name(const Structure& structure) const { return structure.bodies[body].name; }

}  // namespace nurbeam
