#pragma once
#include <vector>

#include "fem/motion/record/sag.h"
#include "fem/motion/record/snapshot.h"

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

  /// Of another state or model of the same mesh, with nothing but these parts. What two places share, as in a
  /// symmetrical shape, is the mean of both: half the difference of the greater ones of two states or models,
  /// one on either side, is that of the means.
  std::vector<BeamRecord> at(const BeamSystem& system, const State& state) const;
  /// Whether more than two places share an extreme: it is the greatest of them, and changes with a single
  /// coordinate only where that makes one of them outdo the others.
  bool are_shared_by_many() const;

 private:
  struct Place {
    int index;       ///< of a span in the mesh or, for displacements, of a node of the beam
    int sample = 0;  ///< in the element
  };
  /// One place on the beam, which may be the end of an element and the beginning of the next.
  using SamePlace = std::vector<Place>;
  /// Where it is: at several places where values are equal.
  struct Held {
    BeamPart part;
    std::vector<SamePlace> places = {};
    Lowest lowest = {};  ///< of a sag, in the mesh
  };
  template <class Value>
  static Extreme value_at(const std::vector<SamePlace>& places, double (*size)(double), const Value& value);
  std::vector<Held> held_;
};

}  // namespace nurbeam
