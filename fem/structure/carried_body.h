#pragma once
#include <string>

#include "fem/structure/grip.h"

namespace nurbeam {

struct Structure;

/// A body that is where another is: the ring of an eyelet on a body. Drawn elsewhere, it comes there as
/// State::load grows to 1.
struct CarriedBody {
  int body;
  int carrier;  ///< the body that carries it

  Grip place() const { return Grip::on_body(body); }
  /// The body's name.
  std::string reaction_name(const Structure& structure) const;
};

}  // namespace nurbeam
