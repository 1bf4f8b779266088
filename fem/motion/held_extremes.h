#pragma once
#include <vector>

#include "fem/motion/sag.h"
#include "fem/motion/snapshot.h"

namespace nurbeam {

/// A part of the record of a beam: an extreme, or, where that is null, its length and sag.
struct BeamPart {
  int beam;
  Extreme BeamRecord::*extreme = nullptr;
};

/// Parts of the records of beams at the places where a state has them: what they are elsewhere changes those
/// of states and models next to it by what is of second order, and few elements tell them.
class HeldExtremes {
 public:
  HeldExtremes(const BeamSystem& system, const State& state, const std::vector<BeamPart>& parts);

  /// Of another state or model of the same mesh, with nothing but these parts.
  std::vector<BeamRecord> at(const BeamSystem& system, const State& state) const;
  /// Whether an extreme is in several elements, or at several nodes, as in a symmetrical shape: it changes
  /// with a single coordinate only where that makes one of them outdo the others.
  bool are_shared() const;

 private:
  struct Place {
    int index;       ///< of a span in the mesh or, for displacements, of a node of the beam
    int sample = 0;  ///< in the element
  };
  /// Where it is: at several places where values are equal.
  struct Held {
    BeamPart part;
    std::vector<Place> places = {};
    Lowest lowest = {};  ///< of a sag, in the mesh
  };
  std::vector<Held> held_;
};

}  // namespace nurbeam
