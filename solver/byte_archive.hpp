// Serialisation of plain values with all digits, for checkpoints.
//
// All members of a plain struct are stored by its declaration (struct_members.hpp). A class with constructors or
// private members, and a struct with derived members, lists its stored members in a function template beside it. The
// structured binding names every member, so that a new member causes a compile error until it is listed:
//   template <class Archive>
//   void visit_members(Archive& archive, ViewFrame& frame) {
//     auto& [origin, e1, e2, w] = frame;
//     archive(origin, e1, e2, w);
//   }
// Numbers are stored in their memory format, little-endian; containers as their size and their elements.
#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/struct_members.hpp"

namespace ashlar {

static_assert(std::endian::native == std::endian::little, "checkpoints are little-endian");

template <class T>
concept PlainNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// A class with its own list of members.
template <class T, class Archive>
concept ListsItsMembers = requires(Archive& archive, T& value) {
  visit_members(archive, value);
};

/// Bytes that a writer collects before it passes them to its sink: fewer need more calls, more need more memory.
inline constexpr std::size_t bytes_at_a_time = std::size_t{1} << 16U;

/// Converts values to bytes, in a string or streamed to a sink, so that the data need not be in memory twice.
class ByteWriter {
 public:
  using Sink = std::function<void(std::string_view)>;

  ByteWriter() = default;
  /// @param sink receives all bytes in parts, the last ones by flush()
  explicit ByteWriter(Sink sink) : sink_(std::move(sink)) {}

  template <class... Values>
  void operator()(const Values&... values) {
    (write(values), ...);
  }
  /// All bytes written. Without a sink only.
  [[nodiscard]] std::string take() { return std::move(bytes_); }
  void flush() {
    if (sink_ && !bytes_.empty()) sink_(bytes_);
    bytes_.clear();
  }

 private:
  template <PlainNumber T>
  void write(const T& value) {
    append(&value, sizeof(T));
  }
  void write(const std::string& text) {
    write_size(text.size());
    append(text.data(), text.size());
  }
  template <class T, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
  void write(const Eigen::Matrix<T, Rows, Columns, Options, MaxRows, MaxColumns>& matrix) {
    write_size(static_cast<std::size_t>(matrix.rows()));
    write_size(static_cast<std::size_t>(matrix.cols()));
    append(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(T));
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write_size(values.size());
    for (const T& value : values) write(value);
  }
  template <class T, std::size_t Size>
  void write(const std::array<T, Size>& values) {
    for (const T& value : values) write(value);
  }
  template <class Key, class Value>
  void write(const std::map<Key, Value>& values) {
    write_size(values.size());
    for (const auto& [key, value] : values) (*this)(key, value);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class T>
  void write(const std::shared_ptr<const T>& value) {
    write(value != nullptr);
    if (value) write(*value);
  }
  template <class T>
  requires std::is_class_v<T>
  void write(const T& value) {
    if constexpr (ListsItsMembers<T, ByteWriter>) {
      // One list of members serves both directions; this one only reads them.
      visit_members(*this, const_cast<T&>(value));
    } else {
      with_members(value, *this);
    }
  }
  void write_size(std::size_t size) { write(static_cast<std::uint64_t>(size)); }
  void append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
    if (sink_ && bytes_.size() >= bytes_at_a_time) flush();
  }

  Sink sink_;
  std::string bytes_;  ///< not yet passed to the sink
};

/// Reads values in the order in which they were written.
/// @throws std::runtime_error if the bytes end too early or a size is invalid.
class ByteReader {
 public:
  /// @param bytes must outlive this
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (read(values), ...);
  }
  [[nodiscard]] bool at_end() const { return left_.empty(); }

 private:
  template <PlainNumber T>
  void read(T& value) {
    take(&value, sizeof(T));
  }
  void read(bool& value) {
    std::uint8_t byte = 0;
    read(byte);
    if (byte > 1) fail();
    value = byte == 1;
  }
  void read(std::string& text) {
    text.resize(read_size(1));
    take(text.data(), text.size());
  }
  template <class T, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
  void read(Eigen::Matrix<T, Rows, Columns, Options, MaxRows, MaxColumns>& matrix) {
    // A matrix without elements may have any number of rows, or of columns.
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    std::uint64_t rows = 0, columns = 0;
    read(rows);
    read(columns);
    const bool fits = (Rows == Eigen::Dynamic || rows == static_cast<std::size_t>(Rows)) &&
                      (Columns == Eigen::Dynamic || columns == static_cast<std::size_t>(Columns)) &&
                      rows <= most && columns <= most;
    if (!fits || rows * columns > left_.size() / sizeof(T)) fail();
    matrix.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    take(matrix.data(), rows * columns * sizeof(T));
  }
  template <class T>
  void read(std::vector<T>& values) {
    values.resize(read_size(1));
    for (T& value : values) read(value);
  }
  template <class T, std::size_t Size>
  void read(std::array<T, Size>& values) {
    for (T& value : values) read(value);
  }
  template <class Key, class Value>
  void read(std::map<Key, Value>& values) {
    values.clear();
    for (std::size_t left = read_size(1); left > 0; --left) {
      Key key;
      read(key);
      read(values[key]);
    }
  }
  template <class T>
  void read(std::optional<T>& value) {
    bool has_value = false;
    read(has_value);
    value.reset();
    if (has_value) read(value.emplace());
  }
  template <class T>
  void read(std::shared_ptr<const T>& value) {
    bool has_value = false;
    read(has_value);
    value.reset();
    if (!has_value) return;
    T stored;
    read(stored);
    value = std::make_shared<const T>(std::move(stored));
  }
  template <class T>
  requires std::is_class_v<T>
  void read(T& value) {
    if constexpr (ListsItsMembers<T, ByteReader>) {
      visit_members(*this, value);
    } else {
      with_members(value, *this);
    }
  }

  /// Reads a number of elements of at least `least_bytes` bytes each.
  std::size_t read_size(std::size_t least_bytes) {
    std::uint64_t size = 0;
    read(size);
    if (size > left_.size() / least_bytes) fail();
    return static_cast<std::size_t>(size);
  }
  void take(void* target, std::size_t size) {
    if (size > left_.size()) fail();
    if (size > 0) std::memcpy(target, left_.data(), size);
    left_.remove_prefix(size);
  }
  [[noreturn]] static void fail() { throw std::runtime_error("stored values end too early"); }

  std::string_view left_;
};

/// FNV-1a of 64 bits.
inline constexpr std::uint64_t hash_offset = 14695981039346656037ULL, hash_prime = 1099511628211ULL;

/// FNV-1a hash of bytes. @param start a former hash to continue
[[nodiscard]] constexpr std::uint64_t hash_bytes(std::string_view bytes, std::uint64_t start = hash_offset) {
  std::uint64_t hash = start;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * hash_prime;
  return hash;
}

}  // namespace ashlar
