// Numbers, vectors, rows and fields.
#include <fmt/format.h>

#include <limits>
#include <type_traits>

#include "apps/scene/json/value_json.hpp"
#include "apps/scene/keys/values_of.hpp"

namespace ashlar::keys {
namespace {

constexpr double not_finite = std::numeric_limits<double>::quiet_NaN();

template <class Member>
class Number : public ValuesOf<Member> {
 public:
  explicit Number(const NumberRange& range) : range_(range) {}
  [[nodiscard]] Json schema() const override { return schema_of_number(range_, "number"); }
  [[nodiscard]] std::string words() const override { return range_.words; }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key, Member& member) const override {
    return table.read_number(key, member, range_);
  }
  [[nodiscard]] Json json_of(const Member& member) const override { return json_or_null(member); }

 private:
  NumberRange range_;
};

/// A number, or a word for an empty optional, which may be held by another optional.
template <class Member>
class NumberOrWord : public ValuesOf<Member> {
 public:
  NumberOrWord(const NumberRange& range, std::string word) : range_(range), word_(std::move(word)) {}
  [[nodiscard]] Json schema() const override {
    return schema_of_any({Json{{"const", word_}}, schema_of_number(range_, "number")});
  }
  [[nodiscard]] std::string words() const override {
    return fmt::format("{} or \"{}\"", range_.words, word_);
  }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key, Member& member) const override {
    std::optional<double> number;
    if (!table.read_number_or_word(key, word_.c_str(), number, range_)) return false;
    if constexpr (std::is_same_v<Member, std::optional<double>>)
      member = number;
    else
      member.emplace(number);
    return true;
  }
  [[nodiscard]] Json json_of(const Member& member) const override {
    if constexpr (std::is_same_v<Member, std::optional<double>>)
      return member ? Json(*member) : Json(word_);
    else
      return !member ? Json(nullptr) : *member ? Json(**member) : Json(word_);
  }

 private:
  NumberRange range_;
  std::string word_;
};

template <class Member>
class WholeNumber : public ValuesOf<Member> {
 public:
  WholeNumber(int low, int high) : low_(low), high_(high) {}
  [[nodiscard]] Json schema() const override {
    return schema_of_number({static_cast<double>(low_), static_cast<double>(high_), true, true, ""},
                            "integer");
  }
  [[nodiscard]] std::string words() const override { return whole_number_words(low_, high_); }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key, Member& member) const override {
    return table.read_integer(key, member, low_, high_);
  }
  [[nodiscard]] Json json_of(const Member& member) const override { return json_or_null(member); }

 private:
  int low_, high_;
};

template <class Member>
class VectorValues : public ValuesOf<Member> {
 public:
  explicit VectorValues(Vector kind) : kind_(kind) {}
  [[nodiscard]] Json schema() const override { return schema_of_row(3); }
  [[nodiscard]] std::string words() const override { return "[x, y, z]"; }
  void spoil(void* member) const override {
    if (kind_ != Vector::any) *static_cast<Member*>(member) = Vector3(Vector3::Constant(not_finite));
  }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key, Member& member) const override {
    Vector3 value;
    if (!(kind_ == Vector::place ? table.read_place(key, value) : table.read_vector(key, value)))
      return false;
    // The length may underflow for a valid direction; the largest component does not.
    if (kind_ == Vector::direction && value.cwiseAbs().maxCoeff() == 0.0) {
      table.error_at_value(
          key, fmt::format("{} has no direction ([0, 0, 0]), a vector other than zero is needed", key));
      return false;
    }
    member = value;
    return true;
  }
  [[nodiscard]] Json json_of(const Member& member) const override {
    if constexpr (std::is_same_v<Member, Vector3>)
      return to_json(member);
    else
      return member ? to_json(*member) : Json(nullptr);
  }

 private:
  Vector kind_;
};

class Row : public ValuesOf<std::array<double, 2>> {
 public:
  explicit Row(const char* words) : words_(words) {}
  [[nodiscard]] Json schema() const override { return schema_of_row(2); }
  [[nodiscard]] std::string words() const override { return words_; }
  void spoil(void* member) const override { static_cast<std::array<double, 2>*>(member)->fill(not_finite); }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key,
                  std::array<double, 2>& member) const override {
    std::vector<double> row;
    if (!table.read_row(key, row, member.size(), words_)) return false;
    member = {row[0], row[1]};
    return true;
  }
  [[nodiscard]] Json json_of(const std::array<double, 2>& member) const override { return member; }

 private:
  const char* words_;
};

class Field : public ValuesOf<SceneField> {
 public:
  Field(std::size_t width, const char* words) : width_(width), words_(words) {}
  [[nodiscard]] Json schema() const override { return schema_of_row(width_); }
  [[nodiscard]] std::string words() const override { return words_; }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key, SceneField& member) const override {
    return table.read_field(key, member, width_, words_);
  }
  [[nodiscard]] Json json_of(const SceneField& member) const override {
    return member.given() ? to_json(member) : Json(nullptr);
  }

 private:
  std::size_t width_;
  const char* words_;
};

}  // namespace

Shared number_values(const double*, const NumberRange& range) {
  return shared<Number<double>>(range);
}
Shared number_values(const std::optional<double>*, const NumberRange& range) {
  return shared<Number<std::optional<double>>>(range);
}
Shared number_or_word(const std::optional<double>*, const NumberRange& range, const char* word) {
  return shared<NumberOrWord<std::optional<double>>>(range, word);
}
Shared number_or_word(const std::optional<std::optional<double>>*, const NumberRange& range,
                      const char* word) {
  return shared<NumberOrWord<std::optional<std::optional<double>>>>(range, word);
}
Shared whole_values(const int*, int low, int high) {
  return shared<WholeNumber<int>>(low, high);
}
Shared whole_values(const std::optional<int>*, int low, int high) {
  return shared<WholeNumber<std::optional<int>>>(low, high);
}
Shared row_values(const std::array<double, 2>*, const char* words) {
  return shared<Row>(words);
}
Shared field_values(const SceneField*, std::size_t width, const char* words) {
  return shared<Field>(width, words);
}
Shared vector_values(const Vector3*, Vector kind) {
  return shared<VectorValues<Vector3>>(kind);
}
Shared vector_values(const std::optional<Vector3>*, Vector kind) {
  return shared<VectorValues<std::optional<Vector3>>>(kind);
}

}  // namespace ashlar::keys
