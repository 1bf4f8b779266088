#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "fem/element/fixed_lanes.h"
#include "fem/mesh/mesh.h"
#include "fem/model/beam_model.h"

namespace nurbeam {

/// One of 4096 places along a beam, the one next to s [m]: the drawing beside places that move is looked up
/// there, which takes no time until they come to the next one.
double near_place(const Beam& beam, double s);

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
    double s_a, s_b;  ///< where its shape was found in the drawing [m]
  };
  void draw(const Beam& beam, double s_a, double s_b, int number);
  void move(const Beam& beam, Moving& moving, const State& state);

  std::vector<Eight> spans_;
  std::vector<Moving> moving_;
};

}  // namespace nurbeam
