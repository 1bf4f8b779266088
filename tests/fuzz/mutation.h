#pragma once
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace nurbeam {

/// A file's content with one to four random changes: bytes, numbers, references, keywords, lines, a cut, a
/// repeated or moved block, or the rest of another file. The same `random` state gives the same bytes
/// everywhere.
///
/// `others`: contents to splice from, not empty.
std::string mutated(const std::string& content, const std::vector<std::string>& others,
                    std::mt19937_64& random);

}  // namespace nurbeam
