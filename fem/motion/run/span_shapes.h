#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "fem/element/fixed_lanes.h"
#include "fem/mesh/mesh.h"
#include "fem/model/beam_model.h"

namespace nurbeam {

/// What the nodes of a beam's spans tell of their shape: strain is Green's mean strain of the cubic through
/// the nodal values, less that of the drawing; curvature likewise, its larger at both ends.
struct ShapeExtremes {
  double tension = 0, compression = 0;  ///< largest strain and its opposite
  double bending = 0;                   ///< largest change of curvature [1/m]
  double stress = 0;                    ///< largest of |strain| + radius * bending
  double squared_strain = 0;            ///< integral over the beam [m]
  double squared_bending = 0;           ///< mean over both ends, times length [1/m]
};

/// The spans of a beam, eight side by side: a step is looked at in little time.
class SpanShapes {
 public:
  SpanShapes() = default;
  /// `state`: of places that move. `mesh` must outlive it.
  SpanShapes(const Beam& beam, const Mesh& mesh, int number, const State& state);

  /// `radius`: of ShapeExtremes::stress [m].
  template <int D>
  ShapeExtremes extremes(const Beam& beam, const State& state, double radius);

 private:
  static constexpr int lanes = FixedLanes::lanes;
  struct Eight {
    std::array<std::array<int, lanes>, 2> place, slope;  ///< first coordinates at both ends
    ElementLanes length, strain, curvature[2];           ///< as drawn
    ElementLanes counted;                                ///< length; 0 where a lane repeats a span
  };
  struct Moving {
    const MeshSpan* span;
    int number;
  };
  void draw(const Beam& beam, const MeshSpan& span, int number, const State& state);

  std::vector<Eight> spans_;
  std::vector<Moving> moving_;
};

}  // namespace nurbeam
