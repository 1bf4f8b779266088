#include "pipelines/results/checked_json.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "pipelines/results/checksum.h"
#include "pipelines/results/file_hash.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* key = "checksum";

std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string read(const std::filesystem::path& file) {
  if (std::filesystem::exists(file) && !std::filesystem::is_regular_file(file))
    throw std::invalid_argument(file.string() + ": is no file; expected one that nurbeam has written");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (text.bad()) throw std::bad_alloc();  // streams keep it to themselves
  if (!stream)
    throw std::invalid_argument(file.string() + ": " + std::strerror(errno) +
                                "; expected a directory that nurbeam run has written");
  return std::move(text).str();
}

}  // namespace

std::string with_checksum(const std::string& object) {
  Json json = Json::parse(object);
  json[key] = sha256_of_text(text_of(json, -1));
  return text_of(json, 2) + "\n";
}

std::string checked_json(const std::filesystem::path& file) {
  Json json = Json::parse(read(file), nullptr, false);
  if (!json.is_object()) throw std::invalid_argument(file.string() + ": is not a JSON object");
  if (!json.contains(key)) return text_of(json, 2) + "\n";
  const Json told = json[key];
  json.erase(key);
  if (told != sha256_of_text(text_of(json, -1))) fail_as_damaged(file.string());
  return text_of(json, 2) + "\n";
}

}  // namespace nurbeam
