// The keys of a table of a scene, declared once. Reading with all faults, JSON, schema and the rows of the reference are
// derived from the declaration.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/keys/key.hpp"

namespace ashlar::keys {

/// The keys of a table, whatever its struct.
class TableKeys {
 public:
  /// Checks values that were read. @return false after a fault
  using Rule = std::function<bool(TomlTableReader& table, void* object)>;

  /// @param meaning of the table. @param defaults a struct that was not read
  TableKeys(std::string meaning, std::vector<AnyKey> keys, std::vector<Rule> rules,
            std::shared_ptr<const void> defaults)
      : meaning_(std::move(meaning)),
        keys_(std::move(keys)),
        rules_(std::move(rules)),
        defaults_(std::move(defaults)) {}

  /// The keys of tables of several kinds in one, to be described: those of all, then those of each kind.
  [[nodiscard]] static TableKeys of_any(std::string meaning, const TableKeys& common,
                                        const std::vector<const TableKeys*>& kinds);

  /// Faults go to the table's diagnostics. @return true if there is none
  bool read(TomlTableReader& table, void* object) const;
  /// Reads the table that a key of another one holds; its keys become known even if it is absent.
  bool read_table(TomlTableReader& parent, const std::string& key, void* object) const;
  /// Keys in the order of their declaration.
  [[nodiscard]] Json json(const void* object) const;
  [[nodiscard]] Json schema() const;
  /// [{ key, value, unit, default, meaning }, ...] of the reference; keys of inner tables follow that of their table,
  /// which has a row if it has a meaning.
  [[nodiscard]] Json rows() const;
  /// See Values::spoil.
  void spoil(void* object) const;

  [[nodiscard]] const std::vector<AnyKey>& keys() const { return keys_; }

 private:
  bool read_values(TomlTableReader& table, void* object) const;
  bool check_presence(TomlTableReader& table, const AnyKey& key, const void* object) const;
  void add_rows(Json& rows, const std::string& prefix) const;

  std::string meaning_;
  std::vector<AnyKey> keys_;
  std::vector<Rule> rules_;
  std::shared_ptr<const void> defaults_;
};

/// The keys of a table that is read into a Struct. Tables are constants of their sources, whose order of initialization is
/// not known: one that contains another one has the function that returns it.
template <class Struct>
class Keys {
 public:
  using Rule = bool (*)(TomlTableReader&, Struct&);

  Keys(const char* meaning, std::vector<Key<Struct>> keys, const std::vector<Rule>& rules = {})
      : table_(meaning, erased(std::move(keys)), erased(rules), std::make_shared<const Struct>()) {}

  [[nodiscard]] Struct read(TomlTableReader& table) const {
    Struct object;
    table_.read(table, &object);
    return object;
  }
  /// Keys that are absent leave their members. @return true if there is no fault
  bool read(TomlTableReader& table, Struct& object) const { return table_.read(table, &object); }
  /// See TableKeys::read_table.
  bool read_table(TomlTableReader& parent, const char* key, Struct& object) const {
    return table_.read_table(parent, key, &object);
  }
  /// The entries of a list of such tables.
  [[nodiscard]] std::vector<Struct> read_all(TomlTableReader& table, const char* key) const {
    return table.read_tables(key, [this](TomlTableReader& entry) { return read(entry); });
  }
  [[nodiscard]] Json json(const Struct& object) const { return table_.json(&object); }
  [[nodiscard]] const TableKeys& table() const { return table_; }

 private:
  static std::vector<AnyKey> erased(std::vector<Key<Struct>> keys) {
    return {std::make_move_iterator(keys.begin()), std::make_move_iterator(keys.end())};
  }
  static std::vector<TableKeys::Rule> erased(const std::vector<Rule>& rules) {
    std::vector<TableKeys::Rule> result;
    for (const Rule rule : rules)
      result.emplace_back([rule](TomlTableReader& table, void* object) {
        return rule(table, *static_cast<Struct*>(object));
      });
    return result;
  }

  TableKeys table_;
};

/// Reports a key beside another one that excludes it. @return false
bool refuse_beside(TomlTableReader& table, const std::string& key, const std::string& other);

/// Reports a table that does not have exactly one of some keys. @param what name of what they give: "size"
bool check_one_of(TomlTableReader& table, const char* what, const std::vector<const char*>& keys);

}  // namespace ashlar::keys
