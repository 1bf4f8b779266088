#pragma once
#include <string>
#include <utility>
#include <vector>

#include "pipelines/case/case_keys.h"

/// What the shapes of JSON files are written with.
namespace nurbeam::shapes {

using Kind = Shape::Kind;
inline constexpr bool required = true;

inline Range positive(std::string reason = {}) {
  return {.lower = 0, .open = true, .reason = std::move(reason)};
}
inline Range not_negative() { return {.lower = 0}; }
inline Range from(double lower) { return {.lower = lower}; }
/// Wide enough for every structure, narrow enough for round-off: what lies outside is a wrong unit.
inline Range plausible(double lower, double upper) {
  return {.lower = lower, .upper = upper, .reason = "what lies outside is most likely in another unit"};
}

inline Shape object(std::vector<Key> keys, std::vector<Alternatives> alternatives = {}) {
  return {.kind = Kind::object, .keys = std::move(keys), .alternatives = std::move(alternatives)};
}
inline Shape array(Shape item, int min_items = 0) {
  return {.kind = Kind::array, .items = {std::move(item)}, .min_items = min_items};
}
/// Of any names.
inline Shape map(Shape item) { return {.kind = Kind::map, .items = {std::move(item)}}; }
/// What every step goes through: more are most likely a distribution.
inline Shape short_array(Shape item) {
  Shape shape = array(std::move(item));
  shape.most_items = 10'000;
  return shape;
}
inline Shape either(Shape a, Shape b) {
  return {.kind = Kind::either, .items = {std::move(a), std::move(b)}};
}
inline Shape choice(std::vector<std::string> choices) {
  return {.kind = Kind::choice, .choices = std::move(choices)};
}
inline Shape any_text() { return {.kind = Kind::text}; }
inline Shape name() { return {.kind = Kind::name}; }
inline Shape boolean() { return {.kind = Kind::boolean}; }
inline Shape integer(Range range) { return {.kind = Kind::integer, .range = std::move(range)}; }
inline Shape quantity(Dimension dimension, Range range = {}) {
  return {.kind = Kind::quantity, .dimension = dimension, .range = std::move(range)};
}
inline Shape vector(Dimension dimension, Range of_components = {}) {
  return {.kind = Kind::vector, .dimension = dimension, .range = std::move(of_components)};
}
inline Shape table(Dimension dimension, Range range = {}) {
  return {.kind = Kind::table, .dimension = dimension, .range = std::move(range)};
}
/// Rows [time, x, y, z].
inline Shape vector_table(Dimension dimension, Range of_components) {
  return {.kind = Kind::table, .dimension = dimension, .range = std::move(of_components), .values = 3};
}
/// Rows [argument, value], with the argument's name.
inline Shape rows_over(std::string name, Dimension argument, Dimension dimension, Range range) {
  return {.kind = Kind::table,
          .dimension = dimension,
          .range = std::move(range),
          .argument = argument,
          .argument_name = std::move(name)};
}
/// Rows [s, value].
inline Shape table_over_length(Dimension dimension, Range range) {
  return rows_over("s", Dimension::length, dimension, std::move(range));
}

/// A point in the world.
inline Shape point() { return vector(Dimension::length, plausible(-1e9, 1e9)); }
/// Of a point of a section.
inline Shape offset() {
  Shape shape = array(quantity(Dimension::length, plausible(-1e4, 1e4)), 2);
  shape.most_items = 2;
  return shape;
}
/// A number, or that over time.
inline Shape constant_or_table(Dimension dimension, Range range) {
  return either(quantity(dimension, range), table(dimension, range));
}

/// A place of a beam.
inline Shape place() {
  return either(
      choice({"start", "end"}),
      object({{"length", quantity(Dimension::length, not_negative()),
               "reference arc length from the beam's start"},
              {"fraction", quantity(Dimension::number, {.lower = 0, .upper = 1}),
               "fraction of the beam's reference length"},
              {"near", point(), "the point of the reference curve nearest to this point"},
              {"within", quantity(Dimension::length, not_negative()),
               "maximum distance of that point from the axis; 1 % of the beam's length when omitted", false,
               "near"}},
             {{{"length", "fraction", "near"}, required}}));
}

/// A place of a beam, or one of a body: the name of one of its points, or a point as drawn.
inline Shape place_of_grip() { return {.kind = Kind::either, .items = {name(), place().items[1], point()}}; }
/// The direction of an axis.
inline Shape direction() { return vector(Dimension::number, plausible(-1e9, 1e9)); }

}  // namespace nurbeam::shapes
