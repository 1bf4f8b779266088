#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nurbeam {

/// One pair of a DXF file: a group code and its value.
struct DxfPair {
  int code;
  std::string_view value;

  /// Throws std::runtime_error for a value that is no number.
  double number() const;
  /// Without its decimals. Throws std::runtime_error also for one above 1e9.
  int whole_number() const;
};

/// What stands between two pairs of code 0: an entity, and its number in the section or its
/// block, from 1.
struct DxfEntity {
  std::string_view type;
  int number;
  std::span<const DxfPair> pairs;

  /// The first value of the code; `otherwise` if there is none. Throws std::runtime_error for one that is no
  /// number.
  double number_of(int code, double otherwise) const;
  int whole_number_of(int code, int otherwise) const;
  std::string text_of(int code) const;
  /// All values of the code, in order.
  std::vector<double> numbers_of(int code) const;
  /// The pairs behind the marker (100) of a class up to the next one; all where there is no such marker.
  DxfEntity part_of_class(std::string_view name) const;
};

/// Entities that an INSERT places; its name is group 2 of its head, its base point group 10.
struct DxfBlock {
  DxfEntity head;
  std::vector<DxfEntity> entities;
};

/// A drawing: what its header declares, the entries of its layer table, its blocks and the entities of its
/// section ENTITIES. They point into the pairs, and these into the content.
struct DxfDrawing {
  std::vector<DxfPair> pairs;
  std::optional<int> unit, measurement;  // $INSUNITS, $MEASUREMENT
  std::string code_page;                 // $DWGCODEPAGE
  std::size_t bytes_behind = 0;          // text behind EOF
  std::vector<std::string> strays;       // what stands where nothing reads it, as "LINE behind ENDSEC"
  std::vector<DxfEntity> layers, entities;
  std::vector<DxfBlock> blocks;

  DxfDrawing() = default;
  DxfDrawing(DxfDrawing&&) = default;
};

/// Throws std::runtime_error, naming the line, for a content that is no list of pairs up to one of EOF.
DxfDrawing dxf_drawing(std::string_view content);

}  // namespace nurbeam
