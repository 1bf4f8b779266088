#pragma once
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/case/case_file.h"
#include "pipelines/case/case_json.h"

/// Private to the reader of case files: values of JSON that has been checked against its shape.
namespace nurbeam {

/// Whether a usable value stands under the key.
inline bool has(const Json& object, const char* key) {
  return object.contains(key) && !object[key].is_null();
}

inline double number(const Json& object, const char* key,
                     double otherwise = std::numeric_limits<double>::quiet_NaN()) {
  return has(object, key) ? object[key].get<double>() : otherwise;
}
inline std::optional<double> optional_number(const Json& object, const char* key) {
  return has(object, key) ? std::optional(object[key].get<double>()) : std::nullopt;
}
inline std::optional<int> optional_integer(const Json& object, const char* key) {
  return has(object, key) ? std::optional(object[key].get<int>()) : std::nullopt;
}
inline std::string text(const Json& object, const char* key, const std::string& otherwise = {}) {
  return has(object, key) ? object[key].get<std::string>() : otherwise;
}
inline std::optional<std::string> optional_text(const Json& object, const char* key) {
  return has(object, key) ? std::optional(object[key].get<std::string>()) : std::nullopt;
}
inline bool flag(const Json& object, const char* key) { return has(object, key) && object[key].get<bool>(); }

inline const Json& part(const Json& object, const char* key) {
  static const Json none = Json::object();
  return has(object, key) ? object[key] : none;
}

inline Eigen::Vector3d to_vector(const Json& value) {
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}
inline Eigen::Vector3d vector(
    const Json& object, const char* key,
    const Eigen::Vector3d& otherwise = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())) {
  return has(object, key) ? to_vector(object[key]) : otherwise;
}

inline std::vector<Eigen::Vector3d> points(const Json& object, const char* key) {
  std::vector<Eigen::Vector3d> points;
  for (const Json& item : part(object, key))
    if (!item.is_null()) points.push_back(to_vector(item));
  return points;
}

inline std::vector<double> numbers(const Json& object, const char* key) {
  std::vector<double> numbers;
  for (const Json& item : part(object, key))
    if (!item.is_null()) numbers.push_back(item.get<double>());
  return numbers;
}

inline TimeTable time_table(const Json& object, const char* key) {
  TimeTable table;
  for (const Json& row : part(object, key)) table.emplace_back(row[0].get<double>(), row[1].get<double>());
  return table;
}

/// Rows [time, x, y, z].
inline std::vector<DisplacementTable::Row> vector_table(const Json& object, const char* key) {
  std::vector<DisplacementTable::Row> table;
  for (const Json& row : part(object, key))
    table.emplace_back(row[0].get<double>(),
                       Eigen::Vector3d(row[1].get<double>(), row[2].get<double>(), row[3].get<double>()));
  return table;
}

/// The enumerator whose text stands under the key; the first one if there is none.
template <class Enum>
Enum chosen(const Json& object, const char* key, const std::vector<std::pair<const char*, Enum>>& values) {
  for (const auto& [name, value] : values)
    if (text(object, key) == name) return value;
  return values.front().second;
}

/// Calls read(item, path) for every usable item of an array.
template <class Read>
void for_each_item(const Json& object, const char* key, const std::string& path, Read read) {
  std::size_t index = 0;
  for (const Json& item : part(object, key)) {
    const std::string item_path = child(child(path, key), index++);
    if (!item.is_null()) read(item, item_path);
  }
}

}  // namespace nurbeam
