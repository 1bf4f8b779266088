#include "pipelines/case/fields.h"

#include "pipelines/case/case_values.h"

namespace nurbeam {

const Json* value_under(const Json& object, const char* key) {
  return has(object, key) ? &object[key] : nullptr;
}

void take(const Json& value, double& to) { to = value.get<double>(); }
void take(const Json& value, int& to) { to = value.get<int>(); }
void take(const Json& value, bool& to) { to = value.get<bool>(); }
void take(const Json& value, std::string& to) { to = value.get<std::string>(); }
void take(const Json& value, Eigen::Vector2d& to) {
  std::array<double, 2> components = {0, 0};
  take(value, components);
  to = {components[0], components[1]};
}
void take(const Json& value, Eigen::Vector3d& to) { to = to_vector(value); }
// Another number of them has been reported.
void take(const Json& value, std::array<double, 2>& to) {
  for (std::size_t i = 0; i < 2 && i < value.size(); ++i)
    if (!value[i].is_null()) to[i] = value[i].get<double>();
}
void take(const Json& value, std::vector<std::string>& to) {
  for (const Json& item : value)
    if (!item.is_null()) to.push_back(item.get<std::string>());
}
void take(const Json& value, std::vector<double>& to) {
  for (const Json& item : value)
    if (!item.is_null()) to.push_back(item.get<double>());
}
void take(const Json& value, std::vector<std::vector<double>>& to) {
  for (const Json& item : value)
    if (!item.is_null()) take(item, to.emplace_back());
}
void take(const Json& value, TimeTable& to) {
  if (!value.is_array()) {
    to = {{0, value.get<double>()}};
    return;
  }
  for (const Json& row : value) to.emplace_back(row[0].get<double>(), row[1].get<double>());
}
void take(const Json& value, std::vector<DisplacementTable::Row>& to) {
  for (const Json& row : value)
    to.emplace_back(row[0].get<double>(),
                    Eigen::Vector3d(row[1].get<double>(), row[2].get<double>(), row[3].get<double>()));
}
void take(const Json& value, Place& to) {
  if (value.is_string())
    to.kind = value == "end" ? Place::Kind::end : Place::Kind::start;
  else if (has(value, "length"))
    to = {.kind = Place::Kind::length, .value = number(value, "length")};
  else if (has(value, "fraction"))
    to = {.kind = Place::Kind::fraction, .value = number(value, "fraction")};
  else if (has(value, "near"))
    to = {.kind = Place::Kind::near,
          .point = vector(value, "near"),
          .within = optional_number(value, "within")};
}
std::string text_of_choice(const Json& value) { return value.get<std::string>(); }
bool is_number(const Json& value) { return value.is_number(); }

}  // namespace nurbeam
