#pragma once
#include <STEPControl_Reader.hxx>

namespace nurbeam {

/// Lets OpenCASCADE, which leaves supplemental geometry out (ISO 10303-242: a representation of constructive
/// geometry that is related to that of a part), read its curves as curves of the part: in its place, its
/// unit, under its name. To be called between reading and transfer.
void join_supplemental_geometry(STEPControl_Reader& reader);

}  // namespace nurbeam
