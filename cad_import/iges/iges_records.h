#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nurbeam {

/// An entity of an IGES file, as text.
struct IgesRecord {
  int line = 0;            ///< of the first line of its directory entry, by which others name it
  int type = 0, form = 0;  ///< 0 where they are no numbers
  int matrix = 0;          ///< the line of its transformation, field 7
  std::string name;        ///< its label, with the subscript if that counts
  bool is_torn = false;    ///< a line of its directory entry is lost
};

/// The entities of an IGES file before any kernel sees them, to be changed one by one: a file of which none
/// is changed stays as it was, character by character.
class IgesRecords {
 public:
  /// The delimiters are those of the Global section.
  IgesRecords(const std::string& content, char parameter_delimiter, char record_delimiter);

  const std::vector<IgesRecord>& all() const { return records_; }
  /// The place of the entity whose directory entry begins at a line; npos for none.
  std::size_t at_line(long line) const;

  /// The values of its parameters after the type, without blanks around; empty ones have their default.
  std::vector<std::string> values(std::size_t record) const;
  void set_values(std::size_t record, const std::vector<std::string>& values);
  /// Adds one like it, with these values; returns its place.
  std::size_t add_like(std::size_t record, const std::vector<std::string>& values);
  /// Makes it a null entity (0).
  void leave_out(std::size_t record);
  /// Makes it one that is no part of another, under this transformation where it has none.
  void set_free(std::size_t record, int matrix);

  /// The whole file.
  std::string text() const;

  static constexpr std::size_t npos = static_cast<std::size_t>(-1);

 private:
  struct Lines {
    std::string first, second;  // of the directory, to the letter of the section
    std::string parameters;     // with the record delimiter
  };
  void read_directory(const std::vector<std::string_view>& lines);
  void read_parameter_line(std::string_view line);

  std::string content_, head_;
  char parameter_delimiter_, record_delimiter_;
  std::vector<IgesRecord> records_;
  std::vector<Lines> lines_;
  bool changed_ = false;
};

}  // namespace nurbeam
