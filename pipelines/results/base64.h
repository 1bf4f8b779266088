#pragma once
#include <cstddef>
#include <string>

namespace nurbeam {

/// Bytes as base64 text (RFC 4648, padded).
std::string base64(const void* bytes, std::size_t size);

}  // namespace nurbeam
