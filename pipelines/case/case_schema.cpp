#include "pipelines/case/case_schema.h"

#include <cmath>

#include "pipelines/case/case_json.h"

namespace nurbeam {

namespace {

using Kind = Shape::Kind;

Json schema_of(const Shape& shape);

Json object_schema(const Shape& shape) {
  Json schema = {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
  for (const Key& key : shape.keys) {
    Json property = schema_of(key.shape);
    const std::string detail = property.value("description", "");
    property["description"] = key.description + (detail.empty() ? "" : " (" + detail + ")");
    schema["properties"][key.name] = property;
    if (key.required) schema["required"].push_back(key.name);
    if (!key.needs.empty()) schema["dependentRequired"][key.name] = Json::array({key.needs});
  }
  for (const Alternatives& alternatives : shape.alternatives) {
    Json one_of = Json::array();
    for (const std::string& key : alternatives.keys) one_of.push_back({{"required", Json::array({key})}});
    if (!alternatives.required) one_of.push_back({{"not", {{"anyOf", one_of}}}});
    schema["allOf"].push_back({{"oneOf", one_of}});
  }
  return schema;
}

Json with_range(Json schema, const Range& range) {
  if (std::isfinite(range.lower)) schema[range.open ? "exclusiveMinimum" : "minimum"] = range.lower;
  if (std::isfinite(range.upper)) schema[range.open ? "exclusiveMaximum" : "maximum"] = range.upper;
  return schema;
}

Json quantity_schema(Dimension dimension) {
  if (dimension == Dimension::number) return {{"type", "number"}};
  return {{"type", {"number", "string"}},
          {"description", "in " + default_unit(dimension) + ", or a text with a unit"}};
}

Json rows_schema(const Shape& shape) {
  Json row = Json::array({quantity_schema(shape.argument)});
  for (int i = 0; i < shape.values; ++i) row.push_back(quantity_schema(shape.dimension));
  const int size = 1 + shape.values;
  return {{"type", "array"},
          {"items", {{"type", "array"}, {"prefixItems", row}, {"minItems", size}, {"maxItems", size}}},
          {"minItems", 1}};
}

/// A table whose rows are in a file.
Json file_schema(const Shape& shape) {
  const int columns = 1 + shape.values;
  return {{"type", "object"},
          {"properties",
           {{"file", {{"type", "string"}, {"minLength", 1}, {"description", "CSV file with the rows"}}},
            {"columns",
             {{"type", "array"},
              {"items", {{"type", "string"}}},
              {"minItems", columns},
              {"maxItems", columns},
              {"description", "names of the columns; the first ones when omitted"}}}}},
          {"required", {"file"}},
          {"additionalProperties", false}};
}

Json any_of(const std::vector<Shape>& items) {
  Json schemas = Json::array();
  for (const Shape& item : items) schemas.push_back(schema_of(item));
  return schemas;
}

Json schema_of(const Shape& shape) {
  switch (shape.kind) {
    case Kind::object:
      return object_schema(shape);
    case Kind::map:
      return {{"type", "object"}, {"additionalProperties", schema_of(shape.items[0])}};
    case Kind::array:
      return {{"type", "array"},
              {"items", schema_of(shape.items[0])},
              {"minItems", shape.min_items},
              {"maxItems", shape.most_items}};
    case Kind::either:
      return {{"anyOf", any_of(shape.items)}};
    case Kind::choice:
      return {{"enum", shape.choices}};
    case Kind::text:
      return {{"type", "string"}, {"minLength", 1}};
    case Kind::name:
      return {
          {"type", "string"}, {"maxLength", 250}, {"pattern", "^(?![=+@-])[^,\"\\u0000-\\u001f\\u007f]+$"}};
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::integer:
      return with_range({{"type", "integer"}}, shape.range);
    case Kind::quantity:
      return with_range(quantity_schema(shape.dimension), shape.range);
    case Kind::vector:
      return {{"type", "array"},
              {"items", with_range(quantity_schema(shape.dimension), shape.range)},
              {"minItems", 3},
              {"maxItems", 3}};
    case Kind::table:
      return {{"anyOf", {rows_schema(shape), file_schema(shape)}}};
  }
  return {};
}

}  // namespace

std::string schema_text(const Shape& shape, const std::string& title) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(schema_of(shape));
  return schema.dump(2) + "\n";
}

std::string case_file_schema() { return schema_text(case_keys(), "nurbeam case file"); }

}  // namespace nurbeam
