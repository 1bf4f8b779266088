#pragma once
#include <string>

namespace nurbeam {

/// The text of a DXF drawing in UTF-8. What is no UTF-8 is in the code page that its header declares
/// ($DWGCODEPAGE), else Windows-1252. So is, before AutoCAD 2007, what could be both where the letters of
/// that page have two bytes: UTF-8 has three for them.
std::string drawing_in_utf8(std::string content);

}  // namespace nurbeam
