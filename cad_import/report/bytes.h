#pragma once
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "nurbs/nurbs_curve.h"

/// Values as bytes, for a process on the same machine; doubles bit by bit.
namespace nurbeam {

class ByteWriter {
 public:
  template <class Number>
  void number(Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
  }
  void count(std::size_t value) { number(static_cast<std::uint64_t>(value)); }
  void text(const std::string& value) {
    count(value.size());
    bytes_ += value;
  }
  std::string bytes() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Every read is checked: the sender may have been damaged by the file it read.
class ByteReader {
 public:
  explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}

  template <class Number>
  Number number() {
    require(sizeof(Number));
    Number value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  // A number of things that take at least `size_of_one` bytes each.
  std::size_t count(std::size_t size_of_one) {
    const auto value = number<std::uint64_t>();
    if (value > (bytes_.size() - at_) / size_of_one) fail();
    return value;
  }
  std::string text() {
    const std::size_t size = count(1);
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  bool at_end() const { return at_ == bytes_.size(); }
  [[noreturn]] static void fail() { throw std::runtime_error("damaged message"); }

 private:
  void require(std::size_t size) const {
    if (size > bytes_.size() - at_) fail();
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

void write(ByteWriter& out, const NurbsCurve& curve);
/// Throws std::runtime_error when the bytes are no curve, std::invalid_argument for one that cannot exist.
NurbsCurve read_nurbs_curve(ByteReader& in);

}  // namespace nurbeam
