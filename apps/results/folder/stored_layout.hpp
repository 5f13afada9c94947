// Hash of the stored layout of a type (solver/byte_archive.hpp). It changes as soon as a member of any contained
// struct is added, removed, moved or changed in type. It does not change if members of the same type are swapped, or
// change their meaning.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "solver/byte_archive.hpp"

namespace ashlar {

/// Visits the stored members of values without any elements: each container is visited as if it had one.
class StoredLayout {
 public:
  /// @param version of the meaning of values
  explicit StoredLayout(std::uint64_t version) : hash_(version) {}

  template <class... Values>
  void operator()(Values&... values) {
    (visit(values), ...);
  }
  [[nodiscard]] std::uint64_t hash() const { return hash_; }

 private:
  enum class Kind : std::uint64_t {
    integer,
    fraction,
    text,
    matrix,
    list,
    array,
    map,
    optional,
    shared,
    members,
    end
  };

  void add(Kind kind, std::uint64_t size = 0) {
    ByteWriter bytes;
    bytes(kind, size);
    hash_ = hash_bytes(bytes.take(), hash_);
  }
  template <class T>
  void visit_one() {
    T value{};
    visit(value);
  }

  template <PlainNumber T>
  void visit(T&) {
    add(std::is_floating_point_v<T> ? Kind::fraction : Kind::integer, sizeof(T));
  }
  void visit(std::string&) { add(Kind::text); }
  template <class T, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
  void visit(Eigen::Matrix<T, Rows, Columns, Options, MaxRows, MaxColumns>&) {
    add(Kind::matrix, sizeof(T));
  }
  template <class T>
  void visit(std::vector<T>&) {
    add(Kind::list);
    visit_one<T>();
  }
  template <class T, std::size_t Size>
  void visit(std::array<T, Size>&) {
    add(Kind::array, Size);
    visit_one<T>();
  }
  template <class Key, class Value>
  void visit(std::map<Key, Value>&) {
    add(Kind::map);
    visit_one<Key>();
    visit_one<Value>();
  }
  template <class T>
  void visit(std::optional<T>&) {
    add(Kind::optional);
    visit_one<T>();
  }
  template <class T>
  void visit(std::shared_ptr<const T>&) {
    add(Kind::shared);
    visit_one<T>();
  }
  template <class T>
  requires std::is_class_v<T>
  void visit(T& value) {
    add(Kind::members);
    if constexpr (ListsItsMembers<T, StoredLayout>) {
      visit_members(*this, value);
    } else {
      with_members(value, *this);
    }
    add(Kind::end);
  }

  std::uint64_t hash_;
};

/// Layout of a type.
template <class T>
[[nodiscard]] std::uint64_t stored_layout(std::uint64_t version = 0) {
  T value{};
  StoredLayout layout(version);
  layout(value);
  return layout.hash();
}

}  // namespace ashlar
