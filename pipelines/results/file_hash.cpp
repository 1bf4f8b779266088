#include "pipelines/results/file_hash.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "pipelines/results/file_error.h"
#include "pipelines/results/late_library.h"

namespace nurbeam {

namespace {

// OpenSSL, loaded when something is first hashed: most commands hash nothing, and it takes long to load.
struct Crypto : LateLibrary {
  Crypto() : LateLibrary(NURBEAM_CRYPTO_LIBRARY) {}

// NOLINTNEXTLINE(bugprone-macro-parentheses): it is the name of a member
#define NURBEAM_LATE(name) decltype(&::EVP_##name) name = function<decltype(&::EVP_##name)>("EVP_" #name)
  NURBEAM_LATE(MD_CTX_new);
  NURBEAM_LATE(MD_CTX_free);
  NURBEAM_LATE(sha256);
  NURBEAM_LATE(DigestInit_ex);
  NURBEAM_LATE(DigestUpdate);
  NURBEAM_LATE(DigestFinal_ex);
#undef NURBEAM_LATE
};

const Crypto& crypto() {
  static const Crypto library;
  return library;
}

std::string hexadecimal(const unsigned char* bytes, unsigned count) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (unsigned i = 0; i < count; ++i) text += {digits[bytes[i] / 16], digits[bytes[i] % 16]};
  return text;
}

/// SHA-256 of what a stream holds, at most so many bytes; an empty text when it or OpenSSL fails.
std::string sha256(std::istream& stream, std::uintmax_t most) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(crypto().MD_CTX_new(),
                                                                        crypto().MD_CTX_free);
  bool good = context && crypto().DigestInit_ex(context.get(), crypto().sha256(), nullptr) == 1;
  std::array<char, 1 << 16> buffer;
  while (good && stream && most > 0) {
    stream.read(buffer.data(), static_cast<std::streamsize>(std::min<std::uintmax_t>(most, buffer.size())));
    most -= static_cast<std::uintmax_t>(stream.gcount());
    good = crypto().DigestUpdate(context.get(), buffer.data(), stream.gcount()) == 1;
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned size = 0;
  if (!good || stream.bad() || crypto().DigestFinal_ex(context.get(), digest.data(), &size) != 1) return {};
  return hexadecimal(digest.data(), size);
}

}  // namespace

std::string sha256_of_file(const std::filesystem::path& file, std::uintmax_t most) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, std::string("cannot be read: ") + std::strerror(errno));
  const std::string digest = sha256(stream, most);
  if (digest.empty())
    fail(file, stream.bad() ? std::string("cannot be read: ") + std::strerror(errno)
                            : std::string("OpenSSL offers no SHA-256"));
  return digest;
}

std::string sha256_of_text(const std::string& text) {
  std::istringstream stream(text);
  const std::string digest = sha256(stream, text.size());
  if (digest.empty()) throw std::runtime_error("OpenSSL offers no SHA-256");
  return digest;
}

}  // namespace nurbeam
