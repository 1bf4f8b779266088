#include "pipelines/results/base64.h"

#include <openssl/evp.h>

#include <algorithm>

#include "pipelines/results/late_library.h"

namespace nurbeam {

std::string base64(const void* bytes, std::size_t size) {
  // OpenSSL's, loaded when a report or a file for ParaView is first written.
  static const auto encode_block =
      LateLibrary(NURBEAM_CRYPTO_LIBRARY).function<decltype(&::EVP_EncodeBlock)>("EVP_EncodeBlock");
  constexpr std::size_t block = 3 << 20;  // EVP counts in int
  const auto* input = static_cast<const unsigned char*>(bytes);
  std::string text;
  for (std::size_t at = 0; at < size; at += block) {
    const std::size_t part = std::min(block, size - at), start = text.size();
    text.resize(start + (part + 2) / 3 * 4 + 1);  // EVP ends with a null character
    encode_block(reinterpret_cast<unsigned char*>(text.data() + start), input + at, static_cast<int>(part));
    text.pop_back();
  }
  return text;
}

}  // namespace nurbeam
