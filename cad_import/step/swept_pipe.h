#pragma once
#include <TopoDS_Shape.hxx>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The solid [mm] of the pipe: its axis swept by a disk or an annulus. Throws std::runtime_error when the
/// axis bends more sharply than the radius, or when the sweep gives no valid solid of the
/// volume that the section times the length has. To be called in a child process: OpenCASCADE's sweep may
/// crash.
TopoDS_Shape swept_pipe(const NamedPipe& pipe);

}  // namespace nurbeam
