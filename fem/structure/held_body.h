#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

#include "fem/structure/displacement_table.h"
#include "fem/structure/grip.h"

namespace nurbeam {

struct Structure;

/// A body held at a point in space, or moved from there: the ring of an eyelet, through which a beam runs.
struct HeldBody {
  int body;
  Eigen::Vector3d position;  ///< [m]; a body that is drawn elsewhere moves there as State::load grows to 1
  /// Displacement from the position; State::load scales it as it scales loads.
  std::optional<DisplacementTable> motion = {};

  static constexpr bool from_outside = true;
  Grip place() const { return Grip::on_body(body); }
  /// The body's name.
  std::string reaction_name(const Structure& structure) const;
};

}  // namespace nurbeam
