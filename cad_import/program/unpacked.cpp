#include "cad_import/program/unpacked.h"

#include <zlib.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string_view>

namespace nurbeam {
namespace {

[[noreturn]] void fail(const std::string& why) {
  throw std::runtime_error("the packed file " + why + "; unpack it by hand, or pack it again");
}

/// Inflates `packed`; `window_bits` says in which envelope, as zlib's inflateInit2 does.
std::string inflated(std::string_view packed, int window_bits, std::size_t limit) {
  z_stream stream{};
  if (inflateInit2(&stream, window_bits) != Z_OK) fail("cannot be unpacked");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string content;
  std::array<char, 1 << 16> buffer{};
  int status = Z_OK;
  while (status == Z_OK && content.size() <= limit) {
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = buffer.size();
    status = inflate(&stream, Z_NO_FLUSH);
    content.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (content.size() > limit) fail("holds more than " + std::to_string(limit >> 20) + " MiB");
  if (status != Z_STREAM_END) fail("is damaged");
  return content;
}

std::size_t little_endian(std::string_view text, std::size_t at, std::size_t count) {
  if (at + count > text.size()) fail("is damaged");
  std::size_t value = 0;
  for (std::size_t i = count; i > 0; --i) value = value << 8 | static_cast<unsigned char>(text[at + i - 1]);
  return value;
}

/// The first file of a zip archive (APPNOTE.TXT 4.3.7, the local file header).
std::string first_of_zip(std::string_view archive, std::size_t limit) {
  constexpr std::size_t header = 30, deflated = 8;
  const std::size_t method = little_endian(archive, 8, 2), size = little_endian(archive, 18, 4);
  const std::size_t begin = header + little_endian(archive, 26, 2) + little_endian(archive, 28, 2);
  if (begin > archive.size()) fail("is damaged");
  if (method == deflated) return inflated(archive.substr(begin), -MAX_WBITS, limit);
  if (method != 0) fail("uses a method other than deflate");
  if (begin + size > archive.size()) fail("is damaged");
  return std::string(archive.substr(begin, size));
}

}  // namespace

std::string unpacked(std::string content, std::size_t limit) {
  constexpr int gzip = 16 + MAX_WBITS;
  if (content.starts_with("PK\x03\x04")) return first_of_zip(content, limit);
  if (content.starts_with("\x1F\x8B")) return inflated(content, gzip, limit);
  return content;
}

}  // namespace nurbeam
