#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace nurbeam {

/// One pair of a DXF file: a group code and its value.
struct DxfPair {
  int code;
  std::string_view value;
};

/// What stands between two pairs of code 0: an entity, and its number in the section or its
/// block, from 1.
struct DxfEntity {
  std::string type;
  int number;
  std::vector<DxfPair> pairs;

  /// The first value of the code; `otherwise` if there is none. Throws std::runtime_error for one that is no
  /// number.
  double number_of(int code, double otherwise) const;
  std::string text_of(int code) const;
  /// All values of the code, in order.
  std::vector<double> numbers_of(int code) const;
};

/// Entities that an INSERT places; its name is group 2 of its head, its base point group 10.
struct DxfBlock {
  DxfEntity head;
  std::vector<DxfEntity> entities;
};

/// A drawing: its unit, the entries of its layer table, its blocks and the entities of its section ENTITIES.
/// The pairs point into the content.
struct DxfDrawing {
  int unit = 0;  // $INSUNITS
  std::vector<DxfEntity> layers, entities;
  std::vector<DxfBlock> blocks;
};

/// Throws std::runtime_error, naming the line, for a content that is no list of pairs.
DxfDrawing dxf_drawing(std::string_view content);

}  // namespace nurbeam
