#include "cad_import/program/unpacked.h"

#include <zlib.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "cad_import/files/cad_file_name.h"
#include "cad_import/files/cad_format.h"

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

/// A file of a zip archive: where its local header begins, and what the central directory says of it.
struct ZipEntry {
  std::size_t header, packed_size, method;
  std::string name;
};

std::string content_of(std::string_view archive, const ZipEntry& entry, std::size_t limit) {
  constexpr std::size_t header = 30, deflated = 8;
  const std::size_t begin = entry.header + header + little_endian(archive, entry.header + 26, 2) +
                            little_endian(archive, entry.header + 28, 2);
  if (begin > archive.size()) fail("is damaged");
  if (entry.method == deflated) return inflated(archive.substr(begin), -MAX_WBITS, limit);
  if (entry.method != 0) fail("uses a method other than deflate");
  if (entry.packed_size > archive.size() - begin) fail("is damaged");
  return std::string(archive.substr(begin, entry.packed_size));
}

/// By the central directory (APPNOTE.TXT 4.3.12), else the first by its local header (4.3.7).
std::vector<ZipEntry> entries_of(std::string_view archive) {
  constexpr std::size_t most = 10'000, entry_size = 46;
  constexpr std::string_view end_mark = "PK\x05\x06", entry_mark = "PK\x01\x02";
  const ZipEntry first{0, little_endian(archive, 18, 4), little_endian(archive, 8, 2), ""};
  const std::size_t end = archive.rfind(end_mark);
  if (end == std::string_view::npos) return {first};
  std::vector<ZipEntry> entries;
  for (std::size_t at = little_endian(archive, end + 16, 4); entries.size() < most;) {
    if (at + entry_size > archive.size() || archive.substr(at, entry_mark.size()) != entry_mark) break;
    const std::size_t name = little_endian(archive, at + 28, 2);
    entries.push_back({little_endian(archive, at + 42, 4), little_endian(archive, at + 20, 4),
                       little_endian(archive, at + 10, 2),
                       std::string(archive.substr(at + entry_size, name))});
    at += entry_size + name + little_endian(archive, at + 30, 2) + little_endian(archive, at + 32, 2);
  }
  return entries.empty() ? std::vector{first} : entries;
}

bool is_cad_file(const ZipEntry& entry) {
  return format_by_name(entry.name) && !entry.name.starts_with("__MACOSX/");
}

/// The first that is a CAD file by its name or its content, else the first of all.
Unpacked cad_file_of_zip(std::string_view archive, std::size_t limit) {
  const std::vector<ZipEntry> entries = entries_of(archive);
  std::vector<std::string> names;
  for (const ZipEntry& entry : entries)
    if (is_cad_file(entry)) names.push_back(entry.name);
  for (const ZipEntry& entry : entries)
    if (is_cad_file(entry)) return {content_of(archive, entry, limit), {names.begin() + 1, names.end()}};
  for (const ZipEntry& entry : entries)
    if (std::string content = content_of(archive, entry, limit); format_of(content)) return {content};
  return {content_of(archive, entries.front(), limit)};
}

}  // namespace

Unpacked unpacked(std::string content, std::size_t limit) {
  constexpr int gzip = 16 + MAX_WBITS;
  if (content.starts_with("PK\x03\x04")) return cad_file_of_zip(content, limit);
  if (content.starts_with("\x1F\x8B")) return {inflated(content, gzip, limit)};
  return {std::move(content)};
}

}  // namespace nurbeam
