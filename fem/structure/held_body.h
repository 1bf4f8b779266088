#pragma once
#include <Eigen/Core>
#include <string>

#include "fem/structure/grip.h"

namespace nurbeam {

struct Structure;

/// A body held at a point in space: the ring of an eyelet, through which a beam runs.
struct HeldBody {
  int body;
  Eigen::Vector3d position;  ///< [m]; a body that is drawn elsewhere moves there as State::load grows to 1

  static constexpr bool from_outside = true;
  Grip place() const { return Grip::on_body(body); }
  /// The body's name.
  std::string reaction_name(const Structure& structure) const;
};

}  // namespace nurbeam
