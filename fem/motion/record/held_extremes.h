#pragma once
#include <vector>

#include "fem/motion/record/element_peaks.h"
#include "fem/motion/record/sag.h"
#include "fem/motion/record/snapshot.h"

namespace nurbeam {

/// A part of the record of a beam: an extreme, or, where `extreme` is null, its length and sag.
struct BeamPart {
  int beam;
  Extreme BeamRecord::*extreme = nullptr;
};

/// Parts of the records of beams at fixed places: where a state has its extremes. In neighbouring states and
/// models the true extremes differ from these values by second order only, and few elements are needed.
class HeldExtremes {
 public:
  HeldExtremes(const BeamSystem& system, const State& state, const std::vector<BeamPart>& parts);

  /// Records of another state or model on the same mesh, with these parts alone. Two places that share an
  /// extreme, as in a symmetrical shape, give the mean of both. Its difference between two models, one on
  /// either side, is then half that of the larger values.
  std::vector<BeamRecord> at(const BeamSystem& system, const State& state) const;
  /// Whether more than two places share an extreme. The extreme is then the maximum over them, and it changes
  /// with a coordinate only where that place becomes the largest.
  bool are_shared_by_many() const;

 private:
  struct Place {
    int span;
    double x;  ///< in parts of the element's length
  };
  /// One place on the beam; at a node it is both the end of an element and the start of the next.
  using SamePlace = std::vector<Place>;
  /// The places of an extreme: several where values are equal.
  struct Held {
    BeamPart part;
    std::vector<SamePlace> places = {};
    Lowest lowest = {};  ///< place of the sag, in the mesh
    int layer = -1;      ///< index in BendingLayers of the layer that has the extreme, else -1
  };
  static void hold_place(double s, const std::vector<ElementRecord>& elements, int first,
                         std::vector<SamePlace>& places);
  static void hold(const Place& place, std::vector<SamePlace>& places);
  template <class Value>
  static Extreme value_at(const std::vector<SamePlace>& places, double (*size)(double), const Value& value);
  std::vector<Held> held_;
};

}  // namespace nurbeam
