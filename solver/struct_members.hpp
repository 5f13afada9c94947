// The members of a plain struct, counted and named by the compiler. The declaration is the only list of members, so
// that a new member is stored with the others.
//
// The number of members of an aggregate is the largest number of values it can be initialised with. A structured
// binding then names them, and rejects any other number.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace ashlar {

/// A value of any type, for unevaluated initialisation. Converts as a const object, so that a constructor which
/// accepts any type (that of std::optional) is the better match.
struct AnyValue {
  template <class T>
  operator T() const;  // NOLINT(google-explicit-constructor): conversion is its purpose
};

template <class Struct, class... Values>
concept BraceInitialisable = requires {
  Struct{std::declval<Values>()...};
};

/// Number of members of an aggregate without bases.
template <class Struct, class... Values>
constexpr std::size_t count_members() {
  if constexpr (BraceInitialisable<Struct, Values..., AnyValue>) {
    return count_members<Struct, Values..., AnyValue>();
  } else {
    return sizeof...(Values);
  }
}

/// with_members() of up to 8 members.
template <std::size_t count, class Struct, class Visit>
void with_few_members(Struct& object, Visit& visit) {
  if constexpr (count == 1) {
    auto& [a] = object;
    visit(a);
  }
  if constexpr (count == 2) {
    auto& [a, b] = object;
    visit(a, b);
  }
  if constexpr (count == 3) {
    auto& [a, b, c] = object;
    visit(a, b, c);
  }
  if constexpr (count == 4) {
    auto& [a, b, c, d] = object;
    visit(a, b, c, d);
  }
  if constexpr (count == 5) {
    auto& [a, b, c, d, e] = object;
    visit(a, b, c, d, e);
  }
  if constexpr (count == 6) {
    auto& [a, b, c, d, e, f] = object;
    visit(a, b, c, d, e, f);
  }
  if constexpr (count == 7) {
    auto& [a, b, c, d, e, f, g] = object;
    visit(a, b, c, d, e, f, g);
  }
  if constexpr (count == 8) {
    auto& [a, b, c, d, e, f, g, h] = object;
    visit(a, b, c, d, e, f, g, h);
  }
}

/// with_members() of 9 to 16 members.
template <std::size_t count, class Struct, class Visit>
void with_many_members(Struct& object, Visit& visit) {
  if constexpr (count == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = object;
    visit(a, b, c, d, e, f, g, h, i);
  }
  if constexpr (count == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = object;
    visit(a, b, c, d, e, f, g, h, i, j);
  }
  if constexpr (count == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = object;
    visit(a, b, c, d, e, f, g, h, i, j, k);
  }
  if constexpr (count == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = object;
    visit(a, b, c, d, e, f, g, h, i, j, k, l);
  }
  if constexpr (count == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = object;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m);
  }
  if constexpr (count == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = object;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  }
  if constexpr (count == 15) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = object;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  }
  if constexpr (count == 16) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = object;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
  }
}

/// with_members() of 17 to 20 members.
template <std::size_t count, class Struct, class Visit>
void with_most_members(Struct& object, Visit& visit) {
  if constexpr (count == 17) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = object;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
  }
  if constexpr (count == 18) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = object;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r);
  }
  if constexpr (count == 19) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = object;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s);
  }
  if constexpr (count == 20) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = object;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t);
  }
}

/// Calls visit(first, second, ...) with all members of a plain struct, in the order of their declaration.
template <class Struct, class Visit>
void with_members(Struct& object, Visit&& visit) {
  using Plain = std::remove_const_t<Struct>;
  static_assert(std::is_aggregate_v<Plain>, "a class that is no plain struct needs its own visit_members()");
  constexpr std::size_t count = count_members<Plain>();
  static_assert(count >= 1 && count <= 20, "a struct of at most 20 members can be stored: group some");
  if constexpr (count <= 8) {
    with_few_members<count>(object, visit);
  } else if constexpr (count <= 16) {
    with_many_members<count>(object, visit);
  } else {
    with_most_members<count>(object, visit);
  }
}

}  // namespace ashlar
