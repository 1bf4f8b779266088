#pragma once
#include <Interface_Graph.hxx>
#include <optional>
#include <string>

class StepGeom_TrimmedCurve;

namespace nurbeam {

/// Says the trims of a piece of a parabola anew, in OpenCASCADE's parameter, which is a length in millimetres
/// where ISO 10303-42 has C + F (u^2 x + 2 u y). Which of both the file means is decided by the cartesian
/// points besides, else by the vertices of its edge, else by the system that wrote it, else by the standard.
/// The units of the file must be those that OpenCASCADE goes by. Returns a warning where points and
/// parameters contradict each other or nothing decides. Throws std::runtime_error where a replica of
/// another curve than a parabola or hyperbola is trimmed by parameters, which OpenCASCADE takes for others.
std::optional<std::string> restate_trims(StepGeom_TrimmedCurve& trimmed, const Interface_Graph& graph,
                                         bool by_open_cascade);

/// That the points which trim the piece are not where it begins and ends, as OpenCASCADE reads it; nothing
/// where they are.
std::optional<std::string> misplaced_trims(const opencascade::handle<StepGeom_TrimmedCurve>& trimmed);

}  // namespace nurbeam
