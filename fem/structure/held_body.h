#pragma once
#include <Eigen/Core>
#include <string>

#include "fem/structure/grip.h"

namespace nurbeam {

struct Structure;

/// Holds a body at a point in space: the ring of an eyelet, through which a beam runs.
struct HeldBody {
  int body;
  Eigen::Vector3d position;  ///< [m]; where the body is drawn elsewhere, State::load takes it there

  static constexpr bool from_outside = true;
  Grip place() const { return Grip::on_body(body); }
  /// The name of the body.
  std::string reaction_name(const Structure& structure) const;
};

}  // namespace nurbeam
