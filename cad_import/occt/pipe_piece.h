#pragma once
#include <TopTools_IndexedMapOfShape.hxx>
#include <array>
#include <optional>
#include <vector>

#include "cad_import/occt/pipe_wall.h"

namespace nurbeam {

/// How a piece of a pipe ends: the places of its outline along the centre line, as parameters of that.
struct PipeEnd {
  double low, high;           ///< of the outline
  double middle;              ///< its mean over the turn
  std::optional<double> cut;  ///< where a plane that the outline lies in cuts the centre line
  std::vector<gp_Pnt> outline = {};

  bool is_square() const { return low == high; }
};

/// A wall that turns all the way round, cut in any way at its ends.
struct PipePiece {
  Wall wall;
  std::array<PipeEnd, 2> ends;
};

/// A wall that is cut at right angles.
PipePiece square_piece(const Wall& wall);

/// The pieces of pipes that faces with walls of one surface make together, where they share edges. `faces`:
/// those of the shape, as Wall::face counts them. Faces that do not turn all the way round give none.
std::vector<PipePiece> pipe_pieces(const std::vector<Wall>& walls, const TopTools_IndexedMapOfShape& faces);

/// Whether two walls have the same centre line, however long.
bool have_one_axis(const Wall& a, const Wall& b);

/// How long a step of the parameter is on the centre line, at its middle [mm].
double speed_of(const Wall& wall);

/// The parameter of the centre line, continued beyond its ends if it is a line or a circle, nearest to a
/// point.
double parameter_on(const Wall& wall, const gp_Pnt& point);

}  // namespace nurbeam
