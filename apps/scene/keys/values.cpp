// Flags, texts, names, words and tables.
#include "apps/scene/keys/values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <type_traits>

#include "apps/scene/json/value_json.hpp"
#include "apps/scene/keys/values_of.hpp"

namespace ashlar::keys {
namespace {

template <class Member>
class Flag : public ValuesOf<Member> {
 public:
  [[nodiscard]] Json schema() const override { return {{"type", "boolean"}}; }
  [[nodiscard]] std::string words() const override { return "true or false"; }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key, Member& member) const override {
    bool value = false;
    if (!table.read_bool(key, value)) return false;
    member = value;
    return true;
  }
  [[nodiscard]] Json json_of(const Member& member) const override { return json_or_null(member); }
};

class Text : public ValuesOf<std::string> {
 public:
  [[nodiscard]] Json schema() const override { return schema_of_text(); }
  [[nodiscard]] std::string words() const override { return "a text in quotes"; }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key, std::string& member) const override {
    return table.read_text(key, member);
  }
  [[nodiscard]] Json json_of(const std::string& member) const override { return member; }
};

template <class Member>
class Name : public ValuesOf<Member> {
 public:
  [[nodiscard]] Json schema() const override { return schema_of_text(); }
  [[nodiscard]] std::string words() const override { return "a text in quotes"; }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key, Member& member) const override {
    std::string name;
    if (!table.read_name(key, name)) return false;
    member = Member(std::move(name));
    return true;
  }
  [[nodiscard]] Json json_of(const Member& member) const override {
    if constexpr (std::is_same_v<Member, std::filesystem::path>)
      return member.empty() ? Json(nullptr) : Json(member.string());
    else if constexpr (std::is_same_v<Member, std::string>)
      return member.empty() ? Json(nullptr) : Json(member);
    else
      return json_or_null(member);
  }
};

class Names : public ValuesOf<std::vector<std::string>> {
 public:
  [[nodiscard]] Json schema() const override { return schema_of_array(schema_of_text(), 0); }
  [[nodiscard]] std::string words() const override { return "an array of texts"; }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key,
                  std::vector<std::string>& member) const override {
    return table.read_texts(key, member);
  }
  [[nodiscard]] Json json_of(const std::vector<std::string>& member) const override { return member; }
};

class Pair : public ValuesOf<std::array<std::string, 2>> {
 public:
  [[nodiscard]] Json schema() const override { return schema_of_array(schema_of_text(), 0); }
  [[nodiscard]] std::string words() const override { return "an array of texts"; }

 protected:
  bool read_value(TomlTableReader& table, const std::string& key,
                  std::array<std::string, 2>& member) const override {
    std::vector<std::string> names;
    if (!table.read_texts(key, names)) return false;
    if (names.size() != member.size()) {
      table.error_at_value(
          key,
          fmt::format("{} has the wrong length ({} entries), two block names are needed", key, names.size()));
      return false;
    }
    member = {names[0], names[1]};
    return true;
  }
  [[nodiscard]] Json json_of(const std::array<std::string, 2>& member) const override { return member; }
};

/// An index that no word has stands for none of them.
class Word : public Values {
 public:
  Word(std::vector<std::string> words, std::function<std::size_t(const void*)> get,
       std::function<void(void*, std::size_t)> set)
      : words_(std::move(words)), get_(std::move(get)), set_(std::move(set)) {}

  bool read(TomlTableReader& table, const std::string& key, void* member) const override {
    const std::optional<std::size_t> index = table.read_word(key, words_);
    if (index) set_(member, *index);
    return index.has_value();
  }
  [[nodiscard]] Json json(const void* member) const override {
    const std::size_t index = get_(member);
    return index < words_.size() ? Json(words_[index]) : Json(nullptr);
  }
  [[nodiscard]] Json schema() const override { return {{"enum", words_}}; }
  [[nodiscard]] std::string words() const override {
    return fmt::format("one of \"{}\"", fmt::join(words_, "\", \""));
  }

 private:
  std::vector<std::string> words_;
  std::function<std::size_t(const void*)> get_;
  std::function<void(void*, std::size_t)> set_;
};

class Words : public Values {
 public:
  Words(std::vector<std::string> words, std::function<bool(const void*, std::size_t)> get,
        std::function<void(void*, std::size_t, bool)> set)
      : words_(std::move(words)), get_(std::move(get)), set_(std::move(set)) {}

  bool read(TomlTableReader& table, const std::string& key, void* member) const override {
    std::vector<std::string> chosen;
    if (!table.read_words_among(key, chosen, words_)) return false;
    for (std::size_t k = 0; k < words_.size(); ++k)
      set_(member, k, std::find(chosen.begin(), chosen.end(), words_[k]) != chosen.end());
    return true;
  }
  [[nodiscard]] Json json(const void* member) const override {
    Json chosen = Json::array();
    for (std::size_t k = 0; k < words_.size(); ++k)
      if (get_(member, k)) chosen.push_back(words_[k]);
    return chosen;
  }
  [[nodiscard]] Json schema() const override { return schema_of_array({{"enum", words_}}, 0); }
  [[nodiscard]] std::string words() const override {
    return fmt::format("an array of \"{}\"", fmt::join(words_, "\", \""));
  }

 private:
  std::vector<std::string> words_;
  std::function<bool(const void*, std::size_t)> get_;
  std::function<void(void*, std::size_t, bool)> set_;
};

class Table : public Values {
 public:
  explicit Table(const TableHolder& holder) : holder_(holder) {}

  bool read(TomlTableReader& table, const std::string& key, void* member) const override {
    const TableKeys& keys = holder_.keys();
    if (holder_.always) return keys.read_table(table, key, member) && table.given(key);
    std::optional<TomlTableReader> content = table.table(key);
    if (!content) return false;
    const bool good = keys.read(*content, holder_.create(member));
    if (!good && holder_.drop != nullptr) holder_.drop(member);
    return good;
  }
  [[nodiscard]] Json json(const void* member) const override {
    const void* held = holder_.held(member);
    return held == nullptr ? Json(nullptr) : holder_.keys().json(held);
  }
  [[nodiscard]] Json schema() const override { return holder_.keys().schema(); }
  [[nodiscard]] std::string words() const override { return "a table"; }
  void spoil(void* member) const override {
    if (holder_.always) holder_.keys().spoil(member);
  }
  [[nodiscard]] const TableKeys* inner() const override { return &holder_.keys(); }

 private:
  TableHolder holder_;
};

}  // namespace

Shared flag_values(const bool*) {
  return shared<Flag<bool>>();
}
Shared flag_values(const std::optional<bool>*) {
  return shared<Flag<std::optional<bool>>>();
}
Shared text_values(const std::string*) {
  return shared<Text>();
}
Shared name_values(const std::string*) {
  return shared<Name<std::string>>();
}
Shared name_values(const std::optional<std::string>*) {
  return shared<Name<std::optional<std::string>>>();
}
Shared name_values(const std::filesystem::path*) {
  return shared<Name<std::filesystem::path>>();
}
Shared names_values(const std::vector<std::string>*) {
  return shared<Names>();
}
Shared pair_values(const std::array<std::string, 2>*) {
  return shared<Pair>();
}
Shared word_values(std::vector<std::string> words, std::function<std::size_t(const void*)> get,
                   std::function<void(void*, std::size_t)> set) {
  return shared<Word>(std::move(words), std::move(get), std::move(set));
}
Shared words_values(std::vector<std::string> words, std::function<bool(const void*, std::size_t)> get,
                    std::function<void(void*, std::size_t, bool)> set) {
  return shared<Words>(std::move(words), std::move(get), std::move(set));
}
Shared table_values(TableHolder holder) {
  return shared<Table>(holder);
}

std::string history_words(const char* row) {
  return fmt::format("an array of {} or {{ file, time, values, scale }}", row);
}

Json history_schema(std::size_t width) {
  return schema_of_any({schema_of_array(schema_of_row(width), 1), schema_of_record()});
}

Json json_of_places(const std::vector<Vector3>& places) {
  Json list = Json::array();
  for (const Vector3& place : places) list.push_back(to_json(place));
  return list;
}

Json json_of_file(const SceneRecord& file) {
  return to_json(file);
}

}  // namespace ashlar::keys
