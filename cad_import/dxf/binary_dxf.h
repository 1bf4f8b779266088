#pragma once
#include <string>
#include <string_view>

namespace nurbeam {

/// Whether the content is a DXF drawing in its binary form.
bool is_binary_dxf(std::string_view content);

/// The same drawing as text, every number so that it reads back as itself. Throws std::runtime_error for one
/// that ends before its EOF, or has a group code that DXF does not know.
std::string text_of_binary_dxf(std::string_view content);

}  // namespace nurbeam
