// All numbers of a value that a checkpoint has to store (solver/byte_archive.hpp), to be looked at and changed one by
// one.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "solver/run/checkpoint.hpp"

namespace ashlar::test_support {

/// Visits all numbers in a value. Each container that is empty gets one element first, so that there is one of
/// everything.
class StoredNumbers {
 public:
  using Bytes = std::span<std::byte>;

  template <class T>
  explicit StoredNumbers(T& value) {
    visit(value);
  }
  /// In the order in which they are stored, keys of maps left out. Valid as long as the value is.
  [[nodiscard]] const std::vector<Bytes>& numbers() const { return numbers_; }

  template <class... Values>
  void operator()(Values&... values) {
    (visit(values), ...);
  }

 private:
  template <PlainNumber T>
  void visit(T& value) {
    numbers_.push_back(std::as_writable_bytes(std::span(&value, 1)));
  }
  void visit(std::string& text) {
    if (text.empty()) text = "x";
    for (char& letter : text) visit(letter);
  }
  template <class T, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
  void visit(Eigen::Matrix<T, Rows, Columns, Options, MaxRows, MaxColumns>& matrix) {
    if (matrix.size() == 0)
      matrix.setZero(Rows == Eigen::Dynamic ? 1 : Rows, Columns == Eigen::Dynamic ? 1 : Columns);
    for (Eigen::Index k = 0; k < matrix.size(); ++k) visit(matrix.data()[k]);
  }
  template <class T>
  void visit(std::vector<T>& values) {
    if (values.empty()) values.emplace_back();
    for (T& value : values) visit(value);
  }
  template <class T, std::size_t Size>
  void visit(std::array<T, Size>& values) {
    for (T& value : values) visit(value);
  }
  template <class Key, class Value>
  void visit(std::map<Key, Value>& values) {
    if (values.empty()) values.emplace();
    for (auto& [key, value] : values) visit(value);
  }
  template <class T>
  void visit(std::optional<T>& value) {
    visit(value ? *value : value.emplace());
  }
  template <class T>
  void visit(std::shared_ptr<const T>& value) {
    // A value of its own, which is not constant.
    auto changeable = std::make_shared<T>(value ? *value : T());
    visit(*changeable);
    value = std::move(changeable);
  }
  /// Rows of points follow from these.
  void visit(std::shared_ptr<const PairRows::Values>&) {}
  void visit(ViewFrame& frame) {
    auto& [origin, e1, e2, w] = frame;
    (*this)(origin, e1, e2, w);
  }
  /// All members of a plain struct, regardless of its own list.
  template <class T>
  requires std::is_class_v<T>
  void visit(T& value) {
    if constexpr (std::is_aggregate_v<T>) {
      with_members(value, *this);
    } else {
      visit_members(*this, value);
    }
  }

  std::vector<Bytes> numbers_;
};

}  // namespace ashlar::test_support
