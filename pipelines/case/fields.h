#pragma once
#include <array>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fem/structure/displacement_table.h"
#include "fem/time_table.h"
#include "pipelines/case/place.h"
#include "pipelines/case/shapes.h"
#include "pipelines/diagnostics/findings.h"

/// The rows of the case file: one row says all of a key, its name, what may stand there, the member that
/// takes it, what it means and what holds without it. Rows make the shape (checks, schema, reference) and the
/// reader.
namespace nurbeam {

using Json = nlohmann::ordered_json;

/// The value under a key, null where there is none or where it has been found unusable.
const Json* value_under(const Json& object, const char* key);

/// Takes a value that has been checked against its shape; units are gone by then.
void take(const Json& value, double& to);
void take(const Json& value, int& to);
void take(const Json& value, bool& to);
void take(const Json& value, std::string& to);
void take(const Json& value, Eigen::Vector2d& to);
void take(const Json& value, Eigen::Vector3d& to);
void take(const Json& value, std::array<double, 2>& to);
void take(const Json& value, std::vector<std::string>& to);
void take(const Json& value, std::vector<double>& to);
void take(const Json& value, std::vector<std::vector<double>>& to);
void take(const Json& value, TimeTable& to);  ///< rows, or one number at all times
void take(const Json& value, std::vector<DisplacementTable::Row>& to);
void take(const Json& value, Place& to);
template <class T>
void take(const Json& value, std::optional<T>& to) {
  take(value, to.emplace());
}
/// The text of a choice.
std::string text_of_choice(const Json& value);
bool is_number(const Json& value);

/// One row for a key of an object that is read into an Owner.
template <class Owner>
struct Field {
  Key key;
  /// Takes the value under the key, which is there and usable; may report.
  std::function<void(const Json& value, const std::string& path, Owner&, Findings&)> read;
  bool in_files = true;  ///< else it is for cases that a program makes

  /// What holds when the key is omitted, as the text says; the member's own initial value is that.
  Field otherwise(const std::string& value) && {
    key.description += "; " + value + " when omitted";
    return std::move(*this);
  }
  /// A key that must stand beside this one.
  Field beside(const char* other) && {
    key.needs = other;
    return std::move(*this);
  }
  /// A key whose texts have another unit where the key `of` has this value.
  Field measured_where(const char* of, const char* value, Dimension dimension) && {
    key.other_unit = Key::OtherUnit{of, value, dimension};
    return std::move(*this);
  }
  Field needed() && {
    key.required = true;
    return std::move(*this);
  }
};

/// A key that a function takes. Key and function are set one after the other: where memory runs short, gcc 12
/// destroys an aggregate within an aggregate twice.
template <class Owner>
Field<Owner> field_by(const char* name, Shape shape, const char* help,
                      std::function<void(const Json&, const std::string& path, Owner&, Findings&)> read) {
  Field<Owner> row;
  row.key = Key{name, std::move(shape), help};
  row.read = std::move(read);
  return row;
}
template <class Owner, class Member>
Field<Owner> field(Member Owner::*member, const char* name, Shape shape, const char* help) {
  return field_by<Owner>(
      name, std::move(shape), help,
      [member](const Json& value, const std::string&, Owner& to, Findings&) { take(value, to.*member); });
}
/// One of several values by their texts.
template <class Owner, class Value>
Field<Owner> choice_field(Value Owner::*member, const char* name,
                          const std::vector<std::pair<const char*, Value>>& values, const char* help) {
  std::vector<std::string> names;
  for (const auto& [text, value] : values) names.emplace_back(text);
  return field_by<Owner>(name, shapes::choice(std::move(names)), help,
                         [member, values](const Json& value, const std::string&, Owner& to, Findings&) {
                           for (const auto& [text, chosen] : values)
                             if (text_of_choice(value) == text) to.*member = chosen;
                         });
}

/// All rows of an object.
template <class Owner>
struct Fields {
  std::vector<Field<Owner>> rows;
  std::vector<Alternatives> alternatives = {};

  /// `of_programs`: with the keys of cases that a program makes.
  Shape shape(bool of_programs = false) const {
    std::vector<Key> keys;
    for (const Field<Owner>& row : rows)
      if (row.in_files || of_programs) keys.push_back(row.key);
    return shapes::object(std::move(keys), alternatives);
  }
  /// `path`: of the object, for messages.
  void read(const Json& object, const std::string& path, Owner& to, Findings& findings) const {
    for (const Field<Owner>& row : rows)
      if (const Json* value = value_under(object, row.key.name.c_str()))
        row.read(*value, path.empty() ? row.key.name : path + "." + row.key.name, to, findings);
  }
};

/// An object within another, by its own rows.
template <class Owner, class Part>
Field<Owner> object_field(Part Owner::*member, const char* name, const Fields<Part>& fields,
                          const char* help) {
  return field_by<Owner>(
      name, fields.shape(), help,
      [member, fields](const Json& value, const std::string& path, Owner& to, Findings& findings) {
        fields.read(value, path, to.*member, findings);
      });
}

}  // namespace nurbeam
