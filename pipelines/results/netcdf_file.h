#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nurbeam {

/// An open netCDF file; everything that fails throws std::runtime_error with the file and the reason. Files
/// may be used in several threads, each file in one at a time: calls of netCDF wait for each other.
/// Arrays are row-major; `start` and `count` have one entry per dimension of the variable.
class NetcdfFile {
 public:
  using Sizes = std::vector<std::size_t>;
  enum class Type { real, integer };
  static constexpr std::size_t unlimited = 0;
  /// What netCDF holds where nothing was written.
  static const double fill;

  /// A netCDF-4 file. `packed`: with compression.
  static NetcdfFile create(const std::filesystem::path& file, bool packed = true);
  /// A file in the classic format (CDF-5), which is quicker to write: numbers alone, in variables of fixed
  /// size, all of them defined before the first is put.
  static NetcdfFile create_classic(const std::filesystem::path& file);
  static NetcdfFile open(const std::filesystem::path& file);
  NetcdfFile(NetcdfFile&& other) noexcept;
  NetcdfFile& operator=(NetcdfFile&&) = delete;
  ~NetcdfFile();

  void define_dimension(const std::string& name, std::size_t size);
  /// A variable of fixed size, without compression.
  void define_plain(const std::string& name, Type type, const std::vector<std::string>& dimensions,
                    const std::string& unit, const std::string& long_name);
  /// A variable of which about `rows` of its first dimension are to come: what lies together in the file, and
  /// whether it is worth compressing where the file is packed.
  void define(const std::string& name, Type type, const std::vector<std::string>& dimensions,
              const std::string& unit, const std::string& long_name, std::size_t rows);
  void define_texts(const std::string& name, const std::string& dimension, const std::string& long_name,
                    const std::vector<std::string>& texts);
  /// An attribute of a variable; of the file for "".
  void put_attribute(const std::string& variable, const std::string& name, const std::string& text);
  std::string attribute(const std::string& variable, const std::string& name) const;

  void put(const std::string& name, const Sizes& start, const Sizes& count, const double* values);
  void put(const std::string& name, const Sizes& start, const Sizes& count, const int* values);
  /// Puts what another file has along its unlimited dimensions behind what is there, of the variables that
  /// both have.
  void append(const NetcdfFile& from);
  std::vector<double> doubles(const std::string& name, const Sizes& start, const Sizes& count) const;
  std::vector<int> integers(const std::string& name, const Sizes& start, const Sizes& count) const;
  std::vector<std::string> texts(const std::string& name) const;

  bool has_dimension(const std::string& name) const;
  bool has_variable(const std::string& name) const;
  std::size_t size(const std::string& dimension) const;
  void close();

 private:
  NetcdfFile(std::filesystem::path file, int id, int status);
  void check(int status, const std::string& what) const;
  int dimension(const std::string& name) const;
  int variable(const std::string& name) const;
  int define_variable(const std::string& name, int type, const std::vector<std::string>& dimensions);
  void put_meaning(const std::string& name, const std::string& unit, const std::string& long_name);

  void begin_values();
  std::vector<int> unlimited_dimensions() const;
  void append_rows(const NetcdfFile& from, int variable, std::size_t rows, std::size_t first);

  std::filesystem::path file_;
  int id_;
  bool packed_ = true, is_defined_ = true;
  /// Defined and not yet put: netCDF writes all it knows of a file where values follow definitions.
  std::vector<std::pair<std::string, std::vector<std::string>>> texts_;
};

}  // namespace nurbeam
