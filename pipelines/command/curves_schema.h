#pragma once
#include <string_view>

namespace nurbeam {

/// The JSON schema of files of curves (docs/cad.md, "JSON of curves").
inline constexpr std::string_view curves_schema = R"({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "Curves as NURBS",
  "type": "object",
  "required": ["unit", "curves"],
  "properties": {
    "unit": {
      "description": "of the control points",
      "enum": ["m", "mm", "cm", "inch", "in", "ft", "um", "km", "mile", "mil"]
    },
    "curves": {
      "type": "array",
      "minItems": 1,
      "items": {
        "type": "object",
        "required": ["degree", "knots", "control_points"],
        "additionalProperties": false,
        "properties": {
          "name": {"type": "string"},
          "layer": {"type": "string"},
          "colour": {"description": "#rrggbb", "type": "string"},
          "part": {"description": "path of the part that holds it", "type": "string"},
          "degree": {"type": "integer", "minimum": 1, "maximum": 1000},
          "knots": {
            "description": "degree + 1 more than control points; they do not decrease",
            "type": "array",
            "minItems": 4,
            "items": {"type": "number"}
          },
          "control_points": {
            "description": "not multiplied by their weights",
            "type": "array",
            "minItems": 2,
            "items": {"type": "array", "minItems": 2, "maxItems": 3, "items": {"type": "number"}}
          },
          "weights": {
            "description": "one for each control point; 1 when omitted",
            "type": "array",
            "items": {"type": "number", "exclusiveMinimum": 0}
          }
        }
      }
    }
  }
}
)";

}  // namespace nurbeam
