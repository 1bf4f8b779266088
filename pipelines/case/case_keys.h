#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/case/quantity.h"

namespace nurbeam {

/// The interval a number must lie in.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool open = false;        ///< whether the finite ends themselves are excluded
  std::string reason = {};  ///< why, for the message; may be empty

  bool contains(double value) const;
  /// "greater than 0", "between 0 and 1", "1 or more", ...
  std::string rule() const;
};

struct Key;

/// Keys of an object of which at most one, or exactly one, may be given.
struct Alternatives {
  std::vector<std::string> keys;
  bool required;
};

/// What a JSON value of the case file may be: the one source of the reader's checks and of the JSON schema.
struct Shape {
  enum class Kind {
    object,    ///< `keys`, `alternatives`
    map,       ///< an object of any names, each with `items[0]`
    array,     ///< of `items[0]`, at least `min_items`, at most `most_items`
    either,    ///< the one of `items` that fits the value's JSON type
    choice,    ///< one of `choices`
    text,      ///< not empty
    name,      ///< text that can head a column: no comma, quote or control character
    boolean,   ///<
    integer,   ///< in `range`
    quantity,  ///< a number in SI units or a text with a unit, in `range`
    vector,    ///< three quantities
    table,     ///< rows [`argument`, quantity, ...], the first increasing, with `values` quantities
  };
  Kind kind = Kind::object;
  std::vector<Key> keys;
  std::vector<Alternatives> alternatives = {};
  std::vector<Shape> items = {};
  int min_items = 0;
  int most_items = 1'000'000;
  std::vector<std::string> choices = {};
  Dimension dimension = Dimension::number;
  Range range = {};
  Dimension argument = Dimension::time;
  std::string argument_name = "time";
  int values = 1;
};

/// One key of an object.
struct Key {
  std::string name;
  Shape shape;
  std::string description;
  bool required = false;
  std::string needs = {};  ///< a key that must stand beside this one; "" for none
  /// The unit of its texts where another key of the object has this value.
  struct OtherUnit {
    std::string key, value;
    Dimension dimension;
  };
  std::optional<OtherUnit> other_unit = {};
};

/// The case file.
const Shape& case_keys();

}  // namespace nurbeam
