#pragma once
#include <vector>

#include "cad_import/occt/pipe_piece.h"

namespace nurbeam {

/// The walls of the pieces from where their centre lines begin to where they end. One that is not cut at
/// right angles ends where the plane of its cut meets its centre line, or where this meets that of a pipe
/// that it ends on, which is divided there if it goes on; else midway.
std::vector<Wall> joined_walls(const std::vector<PipePiece>& pieces);

}  // namespace nurbeam
