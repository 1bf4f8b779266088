#pragma once
#include <string>
#include <vector>

#include "cad_import/occt/pipe_piece.h"

namespace nurbeam {

/// Walls from where their centre lines begin to where they end, and the ends that stand anywhere on their
/// cut.
struct JoinedWalls {
  std::vector<Wall> walls;
  std::vector<std::string> remarks = {};
};

/// Those of the pieces. One that is not cut at right angles ends where the plane of its cut meets its centre
/// line, or where this meets that of a pipe that it ends on, which is divided there if it goes on; else
/// midway, with a remark.
JoinedWalls joined_walls(const std::vector<PipePiece>& pieces);

}  // namespace nurbeam
