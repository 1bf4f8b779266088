#include "pipelines/case/case_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>

#include "nurbs/number_text.h"
#include "pipelines/case/quantity.h"
#include "pipelines/case/shapes.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/utf8_text.h"

namespace nurbeam {

namespace {

using Kind = Shape::Kind;

std::string json_kind(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return "an array";
    case Json::value_t::string:
      return "the text " + in_quotes(value.get<std::string>());
    case Json::value_t::boolean:
      return value.get<bool>() ? "true" : "false";
    default:
      return "the number " + value.dump();
  }
}

std::string quantity_hint(Dimension dimension) {
  return dimension == Dimension::number ? std::string("a number")
                                        : "a number in " + default_unit(dimension) +
                                              " or a text with a unit (" + unit_examples(dimension) + ")";
}

/// "[time, value]" of a table.
std::string row_of(const Shape& shape) {
  std::string row = "[" + shape.argument_name;
  for (int i = 0; i < shape.values; ++i)
    row += shape.values == 1 ? ", value" : ", value " + std::to_string(i + 1);
  return row + "]";
}

std::string expected_array(const Shape& shape) {
  if (shape.most_items != shape.min_items) return "an array [...]";
  return "[" + shape.argument_name + "], each " + quantity_hint(shape.items[0].dimension);
}

/// A place of a beam, or one of a body.
bool is_place_of_grip(const Shape& shape) {
  return shape.kind == Kind::either && shape.items.size() == 3 && shape.items[0].kind == Kind::name &&
         shape.items[1].kind == Kind::object && find_key(shape.items[1], "near");
}

const Shape& place_of_beam() {
  static const Shape shape = shapes::place();
  return shape;
}

std::string expected(const Shape& shape) {
  if (is_place_of_grip(shape))
    return "of a beam \"start\", \"end\" or " + expected(shape.items[1]) +
           ", of a body the name of one of its points or " + expected(shape.items[2]);
  switch (shape.kind) {
    case Kind::object:
      return "an object with " + quoted_list(key_names(shape));
    case Kind::map:
      return "an object { \"name\": value, ... }, each value " + expected(shape.items[0]);
    case Kind::array:
      return expected_array(shape);
    case Kind::either:
      return std::accumulate(
          shape.items.begin() + 1, shape.items.end(), expected(shape.items[0]),
          [](const std::string& so_far, const Shape& item) { return so_far + ", or " + expected(item); });
    case Kind::choice:
      return "one of " + quoted_list(shape.choices);
    case Kind::text:
    case Kind::name:
      return "a text in quotes";
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "an integer";
    case Kind::quantity:
      return quantity_hint(shape.dimension);
    case Kind::vector:
      return "[x, y, z], each " + quantity_hint(shape.dimension);
    case Kind::table:
      return "rows [" + row_of(shape) + ", ...], each value " + quantity_hint(shape.dimension) +
             ", or { \"file\": \"x.csv\" }";
  }
  return {};
}

bool fits_json_type(const Shape& shape, const Json& value) {
  switch (shape.kind) {
    case Kind::object:
    case Kind::map:
      return value.is_object();
    case Kind::array:
    case Kind::vector:
    case Kind::table:
      return value.is_array();
    case Kind::integer:
      return value.is_number();
    case Kind::quantity:
      return value.is_number() || value.is_string();
    case Kind::either:
      return std::any_of(shape.items.begin(), shape.items.end(),
                         [&](const Shape& item) { return fits_json_type(item, value); });
    case Kind::boolean:
      return value.is_boolean();
    default:
      return value.is_string();
  }
}

/// What a word of other programs is called here; empty for others.
std::string word_here(const std::string& word) {
  static const std::vector<std::pair<std::string, std::string>> words = {
      {"fixed", "clamped"},     {"encastre", "clamped"}, {"built-in", "clamped"},
      {"rigid", "clamped"},     {"hinge", "pinned"},     {"hinged", "pinned"},
      {"pin", "pinned"},        {"simple", "pinned"},    {"simply supported", "pinned"},
      {"roller", "guided"},     {"slider", "guided"},    {"linear", "static"},
      {"transient", "dynamic"}, {"modal", "modes"},      {"eigenvalues", "modes"},
      {"left", "start"},        {"right", "end"},        {"begin", "start"},
      {"first", "start"},       {"last", "end"}};
  for (const auto& [other, here] : words)
    if (edit_distance(word, other) == 0) return here;
  return "";
}

bool is_place(const Shape& shape) {
  return shape.kind == Kind::either && shape.items[0].kind == Kind::choice &&
         shape.items[1].kind == Kind::object && find_key(shape.items[1], "fraction") &&
         find_key(shape.items[1], "near");
}

bool may_have_rows(const Shape& shape) {
  return shape.kind == Kind::table ||
         (shape.kind == Kind::either && std::any_of(shape.items.begin(), shape.items.end(), may_have_rows));
}

/// What was meant by a place of a beam that is none: "middle", or a number.
std::string meant_place(const Json& value) {
  const auto fraction = [](const std::string& x) { return "{ \"fraction\": " + x + " }"; };
  if (value.is_number()) {
    const double x = value.get<double>();
    const std::string length = "{ \"length\": " + text_of(x) + " }";
    return "; did you mean " + (x >= 0 && x <= 1 ? fraction(text_of(x)) + " or " : "") + length + "?";
  }
  if (!value.is_string()) return "";
  for (const char* middle : {"middle", "mid", "midspan", "center", "centre", "half"})
    if (edit_distance(value.get<std::string>(), middle) == 0)
      return "; did you mean " + fraction("0.5") + "?";
  return "";
}

/// Checks values against shapes, turns every quantity into a number in SI units, and makes what is unusable
/// null (it has been reported), so that what is left can be checked further.
class Checker {
 public:
  /// `whole`: whether a value must have all that it needs.
  explicit Checker(Findings& findings, bool whole) : findings_(findings), whole_(whole) {}

  /// Whether the value is usable.
  bool check(const Shape& shape, Json& value, const std::string& path) {
    if (!whole_ && may_have_rows(shape) && value.is_object() && value.contains("file")) return true;
    switch (shape.kind) {
      case Kind::object:
        return check_object(shape, value, path);
      case Kind::map:
        return check_map(shape, value, path);
      case Kind::array:
        return check_array(shape, value, path);
      case Kind::either:
        return check_either(shape, value, path);
      case Kind::choice:
        return check_choice(shape, value, path);
      case Kind::text:
      case Kind::name:
        return check_text(shape, value, path);
      case Kind::boolean:
        return value.is_boolean() || wrong_type(shape, value, path);
      case Kind::integer:
        return check_integer(shape, value, path);
      case Kind::quantity:
        return check_quantity(shape, value, path);
      case Kind::vector:
        return check_vector(shape, value, path);
      case Kind::table:
        return check_table(shape, value, path);
    }
    return false;
  }

 private:
  bool failed(const std::string& path, std::string message) {
    findings_.error(path, std::move(message));
    return false;
  }
  bool wrong_type(const Shape& shape, const Json& value, const std::string& path) {
    return failed(path, "is " + json_kind(value) + "; expected " + expected(shape));
  }

  bool check_object(const Shape& shape, Json& value, const std::string& path) {
    if (!value.is_object()) return wrong_type(shape, value, path);
    for (const auto& [name, unused] : value.items()) {
      if (!find_key(shape, name)) {
        findings_.error(child(path, name),
                        "unknown key " + in_quotes(name) + known_names(name, key_names(shape)));
      }
    }
    check_presence(shape, value, path);
    for (const Key& key : shape.keys) {
      if (!value.contains(key.name)) continue;
      Json& item = value[key.name];
      const std::string at = child(path, key.name);
      const bool of_beam = value.contains("beam") && is_place_of_grip(key.shape);
      const Shape& own = of_beam ? place_of_beam() : key.shape;
      if (!(has_other_unit(value, key) ? check(in_other_unit(key), item, at) : check(own, item, at)))
        item = nullptr;
    }
    return true;
  }

  static bool has_other_unit(const Json& object, const Key& key) {
    const std::optional<Key::OtherUnit>& other = key.other_unit;
    return other && object[key.name].is_string() && object.value(other->key, Json()) == other->value;
  }
  static Shape in_other_unit(const Key& key) {
    const Shape& usual = key.shape.kind == Kind::either ? key.shape.items[0] : key.shape;
    return {.kind = Kind::quantity, .keys = {}, .dimension = key.other_unit->dimension, .range = usual.range};
  }

  void check_presence(const Shape& shape, const Json& value, const std::string& path) {
    for (const Key& key : shape.keys) {
      if (!whole_) break;
      if (key.required && !value.contains(key.name))
        findings_.error(path, in_quotes(key.name) + " is missing (" + key.description + ")");
      if (value.contains(key.name) && !key.needs.empty() && !value.contains(key.needs))
        findings_.error(path, in_quotes(key.name) + " needs " + in_quotes(key.needs) + " beside it");
    }
    for (const Alternatives& alternatives : shape.alternatives) {
      std::vector<std::string> given;
      std::copy_if(alternatives.keys.begin(), alternatives.keys.end(), std::back_inserter(given),
                   [&](const std::string& key) { return value.contains(key); });
      if (given.size() > 1)
        findings_.error(path, quoted_list(given) + " exclude each other; give one of them");
      else if (given.empty() && alternatives.required && whole_)
        findings_.error(path, "give one of " + quoted_list(alternatives.keys));
    }
  }

  bool check_map(const Shape& shape, Json& value, const std::string& path) {
    if (!value.is_object()) return wrong_type(shape, value, path);
    for (auto& [name, item] : value.items()) {
      Json as_text = name;
      if (!check_text({.kind = Kind::name}, as_text, child(path, name)) ||
          !check(shape.items[0], item, child(path, name)))
        item = nullptr;
    }
    return true;
  }

  bool check_array(const Shape& shape, Json& value, const std::string& path) {
    if (!value.is_array()) return wrong_type(shape, value, path);
    if (value.size() < static_cast<std::size_t>(shape.min_items)) {
      return failed(path, "has " + std::to_string(value.size()) + " item(s); expected at least " +
                              std::to_string(shape.min_items));
    }
    if (value.size() > static_cast<std::size_t>(shape.most_items))
      return failed(path, "has " + std::to_string(value.size()) + " items; expected at most " +
                              std::to_string(shape.most_items));
    for (std::size_t i = 0; i < value.size(); ++i)
      if (!check(shape.items[0], value[i], child(path, i))) value[i] = nullptr;
    return true;
  }

  bool check_either(const Shape& shape, Json& value, const std::string& path) {
    const auto has_it = [&](const Shape& item) {
      return std::find(item.choices.begin(), item.choices.end(), value.get<std::string>()) !=
             item.choices.end();
    };
    const Shape &first = shape.items[0], &second = shape.items[1];
    const bool of_beam = is_place(shape) || (is_place_of_grip(shape) && value.is_number());
    if (const std::string meant = of_beam ? meant_place(value) : ""; !meant.empty())
      return failed(path, "is " + json_kind(value) + meant + " Expected " + expected(shape));
    const bool is_text_with_unit =
        value.is_string() && first.kind == Kind::choice && second.kind == Kind::quantity && !has_it(first);
    if (is_text_with_unit) return check(second, value, path);
    for (const Shape& item : shape.items)
      if (fits_json_type(item, value)) return check(item, value, path);
    return wrong_type(shape, value, path);
  }

  bool check_choice(const Shape& shape, const Json& value, const std::string& path) {
    if (!value.is_string()) return wrong_type(shape, value, path);
    const auto text = value.get<std::string>();
    const auto has = [&](const std::string& word) {
      return std::find(shape.choices.begin(), shape.choices.end(), word) != shape.choices.end();
    };
    if (has(text)) return true;
    const std::string here = word_here(text);
    return failed(
        path, in_quotes(text) + " is not known here" +
                  (has(here) ? "; did you mean " + in_quotes(here) + "? Known: " + quoted_list(shape.choices)
                             : known_names(text, shape.choices)));
  }

  bool check_text(const Shape& shape, const Json& value, const std::string& path) {
    if (!value.is_string()) return wrong_type(shape, value, path);
    const auto text = value.get<std::string>();
    if (text.empty()) return failed(path, "is empty");
    constexpr char delete_character = 0x7f;
    const auto is_barred = [](char c) {
      return c == ',' || c == '"' || (c >= 0 && c < ' ') || c == delete_character;
    };
    if (shape.kind != Kind::name) return true;
    constexpr std::size_t longest = 250;  // characters
    const std::string shown = in_quotes(first_characters(text, longest));
    if (const std::size_t length = character_count(text); length > longest)
      return failed(path, shown + ": a name must have at most " + std::to_string(longest) +
                              " characters, not " + std::to_string(length));
    if (std::any_of(text.begin(), text.end(), is_barred))
      return failed(path, shown + ": a name must not hold commas, quotes or control characters");
    if (std::string_view("=+-@").find(text.front()) != std::string_view::npos)
      return failed(path,
                    shown +
                        ": a name must not begin with = + - or @, which spreadsheets take for a formula in "
                        "histories.csv; begin with a letter or a digit");
    return true;
  }

  bool in_range(const Shape& shape, double value, const std::string& path) {
    if (shape.range.contains(value)) return true;
    const std::string unit = shape.dimension == Dimension::number ? "" : " " + default_unit(shape.dimension);
    return failed(path, "is " + text_of(value, all_digits) + unit + "; must be " + shape.range.rule() +
                            (shape.range.reason.empty() ? "" : " (" + shape.range.reason + ")"));
  }

  bool check_integer(const Shape& shape, Json& value, const std::string& path) {
    if (!value.is_number()) return wrong_type(shape, value, path);
    const double number = value.get<double>();
    if (number != std::floor(number))
      return failed(path, "is " + text_of(number, all_digits) + "; expected an integer");
    if (!in_range(shape, number, path)) return false;
    constexpr int largest = std::numeric_limits<int>::max();
    if (std::abs(number) > largest) {
      return failed(path,
                    "is " + text_of(number, all_digits) + "; must be at most " + std::to_string(largest));
    }
    value = static_cast<int>(number);
    return true;
  }

  bool check_quantity(const Shape& shape, Json& value, const std::string& path) {
    if (value.is_string()) {
      const ParsedQuantity quantity = parse_quantity(value.get<std::string>(), shape.dimension);
      if (!quantity.value) return failed(path, quantity.error);
      value = *quantity.value;
    }
    if (!value.is_number()) return wrong_type(shape, value, path);
    value = value.get<double>();
    return in_range(shape, value.get<double>(), path);
  }

  bool check_vector(const Shape& shape, Json& value, const std::string& path) {
    if (!value.is_array()) return wrong_type(shape, value, path);
    if (value.size() != 3)
      return failed(path, "has " + std::to_string(value.size()) + " item(s); expected " + expected(shape));
    const Shape component = {.kind = Kind::quantity, .dimension = shape.dimension, .range = shape.range};
    bool usable = true;
    for (std::size_t i = 0; i < 3; ++i) usable = check(component, value[i], child(path, i)) && usable;
    return usable;
  }

  bool check_table(const Shape& shape, Json& value, const std::string& path) {
    if (value.is_null()) return false;  // a file whose fault has been reported
    if (!value.is_array()) return wrong_type(shape, value, path);
    if (value.empty()) return failed(path, "has no rows; expected " + expected(shape));
    const Shape argument = {.kind = Kind::quantity, .dimension = shape.argument};
    const Shape entry = {.kind = Kind::quantity, .dimension = shape.dimension, .range = shape.range};
    double last = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < value.size(); ++i) {
      Json& row = value[i];
      const std::string row_path = child(path, i);
      if (!row.is_array() || row.size() != 1 + static_cast<std::size_t>(shape.values))
        return failed(row_path, "expected a row " + row_of(shape));
      for (std::size_t k = 0; k < row.size(); ++k)
        if (!check(k == 0 ? argument : entry, row[k], child(row_path, k))) return false;
      if (row[0].get<double>() <= last) {
        const std::string unit =
            shape.argument == Dimension::number ? "" : " " + default_unit(shape.argument);
        const std::string values = shape.argument_name == "time" ? "times"
                                   : shape.argument_name == "s"  ? "places"
                                                                 : "its values";
        const std::string is = shape.argument_name + (shape.argument_name == "s" ? " = " : " ");
        return failed(row_path, is + text_of(row[0].get<double>(), all_digits) + unit +
                                    " does not come after " + text_of(last, all_digits) + unit + "; " +
                                    values + " must increase");
      }
      last = row[0].get<double>();
    }
    return true;
  }

  Findings& findings_;
  bool whole_;
};

}  // namespace

bool check_shape(const Shape& shape, Json& value, Findings& findings) {
  return Checker(findings, true).check(shape, value, "");
}

bool check_part(const Shape& shape, Json& value, Findings& findings) {
  return Checker(findings, false).check(shape, value, "");
}

}  // namespace nurbeam
