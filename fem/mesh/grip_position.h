#pragma once
#include <optional>
#include <string>

#include "fem/mesh/mesh.h"
#include "fem/structure/grip.h"

namespace nurbeam {

/// First position coordinate of a grip; nothing for a point in space. A place of a beam needs a node that it
/// keeps: throws std::invalid_argument where the mesh has none; the message begins with `what`.
std::optional<int> grip_position(const Structure& structure, const Mesh& mesh, const Grip& grip,
                                 const std::string& what);

}  // namespace nurbeam
