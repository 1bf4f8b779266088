#pragma once
#include <optional>
#include <string>

#include "cad_import/report/format.h"

namespace nurbeam {

/// The format of a file with this content: STEP begins with "ISO-10303-21", and IFC too, with a schema of
/// that; IGES has an 'S' in column 73 of
/// its first line, DXF begins with the pair "0", "SECTION", perhaps behind comments ("999"), BREP with
/// "DBRep_DrawableShape" or "CASCADE Topology V"; nothing for any other content.
std::optional<CadFormat> format_of(const std::string& content);

/// Why the content is not a whole file of the format (nothing if it is): STEP ends with END-ISO-10303-21,
/// IGES with a line that has a 'T' in column 73; BREP has a section TShapes. That of DXF ends with a pair of
/// EOF, which its reader sees.
std::optional<std::string> incompleteness(const std::string& content, CadFormat format);

/// How the lines of an IGES file differ from the numbers of lines in its Terminate section (nothing if
/// they agree): OpenCASCADE passes over entities whose lines are damaged.
std::optional<std::string> miscounted_lines(const std::string& content);

}  // namespace nurbeam
