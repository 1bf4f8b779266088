#pragma once
#include <cstddef>
#include <cstdint>

/// What a child process sends: a status byte, the size of the text, the text.
namespace nurbeam::child_message {

constexpr char done = 'D';
constexpr char failed = 'F';
constexpr char out_of_memory = 'M';
constexpr std::size_t header_size = 1 + sizeof(std::uint64_t);
/// The descriptor that it sends to; it is asked on the standard input.
constexpr int descriptor = 3;

}  // namespace nurbeam::child_message
