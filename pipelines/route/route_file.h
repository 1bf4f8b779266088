#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/route/route.h"

namespace nurbeam {

/// The cables of a file, or of a text of that form, with the places that they join resolved.
struct RouteFile {
  std::vector<RouteRequest> cables;  ///< empty where any diagnostic is an error
  std::vector<Diagnostic> diagnostics;
};

/// Reads a file of cables:
///
///   {
///     "nurbeam_route": 1,
///     "gravity": [0, 0, -9.81],
///     "cables": [{
///       "name": "lead",
///       "from": {"point": [0, 0, 0], "direction": [1, 0, 0]},
///       "to": {"file": "plug.step", "curve": "rim", "at": "centre", "flip": true},
///       "length": "1.2 m",
///       "section": {"radius": "3 mm"}, "material": {"density": 1400, "youngs_modulus": "2 GPa"}
///     }]
///   }
///
/// In place of "length" there may be "slack", a part of the distance of the ends, or "least_bend_radius".
/// An end is a point with the direction in which the cable leaves it, or a place of a curve of a CAD file:
/// its "start" or "end", where the cable continues the curve, or the "centre" of a closed plane curve, as the
/// rim of a face, along the normal about which the curve turns by the right hand, or with "flip" against it.
RouteFile read_route_file(const std::filesystem::path& file);
/// The same of a text; `file` heads the messages, and files that it names are relative to its folder.
RouteFile read_route_text(const std::string& text, const std::filesystem::path& file);

/// Where a cable leaves a curve: at an end, along its tangent away from the curve; or at the centre of the
/// area inside a closed plane curve. `place`: "start", "end" or "centre". Throws std::invalid_argument, with
/// the reason, where the curve has no such place.
RouteEnd end_at(const NurbsCurve& curve, const std::string& place);

}  // namespace nurbeam
