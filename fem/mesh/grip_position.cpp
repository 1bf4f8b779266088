#include "fem/mesh/grip_position.h"

#include <stdexcept>

#include "nurbs/number_text.h"

namespace nurbeam {

std::optional<int> grip_position(const Structure& structure, const Mesh& mesh, const Grip& grip,
                                 const std::string& what) {
  if (grip.is_point()) return std::nullopt;
  if (grip.body >= 0) return mesh.bodies[grip.body];
  const Beam& beam = structure.beams[grip.beam];
  const int home = beam.home_at(grip.s);
  for (const MeshNode& node : mesh.nodes[grip.beam])
    if (home >= 0 && node.home == home) return node.r;
  throw std::invalid_argument(what + " at s = " + text_of(grip.s) + " m of beam \"" + beam.name +
                              "\" needs a node that stays there");
}

}  // namespace nurbeam
