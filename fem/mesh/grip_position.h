#pragma once
#include <optional>
#include <string>

#include "fem/mesh/mesh.h"
#include "fem/structure/grip.h"

namespace nurbeam {

/// Where the position of a grip stands among the coordinates; nothing for a point in space. A place of a beam
/// needs a node that stays there: std::invalid_argument, with `what` takes hold, where the mesh has none.
std::optional<int> grip_position(const Structure& structure, const Mesh& mesh, const Grip& grip,
                                 const std::string& what);

}  // namespace nurbeam
