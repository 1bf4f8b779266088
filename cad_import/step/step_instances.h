#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace nurbeam {

/// The instances of the data section of a STEP file (ISO 10303-21) as text, to be changed one by one: what is
/// not changed stays as it was, character by character.
class StepInstances {
 public:
  /// Throws std::runtime_error when the text has no instance, or one of a number twice.
  explicit StepInstances(std::string content);

  /// What stands between "#number =" and ";". Throws std::runtime_error when there is no such instance.
  const std::string& value(int number) const;
  void replace(int number, std::string value);
  /// Adds an instance; returns its number.
  int add(std::string value);

  /// "EDGE_CURVE" of "EDGE_CURVE('',#1,#2,#3,.T.)"; "" of a complex instance.
  std::string keyword(int number) const;
  /// The numbers an instance refers to, in order.
  std::vector<int> references(int number) const;
  /// The instances that refer to this one.
  const std::vector<int>& users(int number) const;
  /// Those with this keyword.
  std::vector<int> with_keyword(std::string_view keyword) const;
  /// The name of a representation item as it is encoded in the file, without quotes.
  std::string encoded_name(int number) const;

  /// The whole file.
  std::string text() const;

 private:
  std::string content_;
  struct Instance {
    std::size_t begin, end;  // of its value in content_
    std::string value;
  };
  std::map<int, Instance> instances_;
  std::map<int, std::vector<int>> users_;
  std::vector<int> added_;
};

}  // namespace nurbeam
