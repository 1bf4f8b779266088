#include "pipelines/run/model_digest.h"

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipelines/results/file_hash.h"

namespace nurbeam {

namespace {

std::map<std::string, std::string> parts_of(const std::string& digest) {
  std::map<std::string, std::string> parts;
  std::istringstream lines(digest);
  for (std::string key, hash; lines >> key >> hash;) parts[key] = hash;
  return parts;
}

}  // namespace

std::string model_digest(const CaseFile& c, const BuiltModel& built) {
  std::string text, files;
  const auto json = nlohmann::json::parse(c.json);
  for (const auto& [key, value] : json.items())
    if (key != "analysis" && key != "output" && key != "name")
      text += key + " " + sha256_of_text(value.dump()) + "\n";
  for (const auto& file : built.inputs) files += sha256_of_file(file) + "\n";
  return text + "files " + sha256_of_text(files) + "\n";
}

std::string text_without_accuracy(const CaseFile& c) {
  auto json = nlohmann::ordered_json::parse(c.json);
  if (!json.contains("analysis") || !json["analysis"].contains("accuracy")) return c.json;
  json["analysis"].erase("accuracy");
  return json.dump();
}

std::vector<std::string> differing_parts(const std::string& a, const std::string& b) {
  const std::map<std::string, std::string> of_a = parts_of(a), of_b = parts_of(b);
  std::map<std::string, std::string> all = of_a;
  all.insert(of_b.begin(), of_b.end());
  std::vector<std::string> differing;
  for (const auto& [key, hash] : all)
    if (!of_a.contains(key) || !of_b.contains(key) || of_a.at(key) != of_b.at(key)) differing.push_back(key);
  return differing;
}

}  // namespace nurbeam
