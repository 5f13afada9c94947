// HDF5 files: the only code that uses the HDF5 library.
//
// A table is a dataset whose first dimension grows: rows of numbers, or of texts. Tables are stored in chunks of whole
// rows. Nothing in a file depends on the time at which it was written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ashlar {

/// Type of a table's values, little-endian. `text` is UTF-8 of any length but declared as ASCII, as VTK's reader asks
/// for ASCII and the library does not convert.
enum class Hdf5Type { real64, real32, integer32, integer64, unsigned8, text };

/// Layout of a table, fixed when it is created.
struct Hdf5Table {
  Hdf5Type type = Hdf5Type::real64;
  int columns = 0;               ///< values of a row; 0: one value, in a dataset of one dimension
  std::uint64_t chunk_rows = 1;  ///< rows of a chunk, >= 1
  bool compressed = false;       ///< shuffle and deflate filters, which every HDF5 library has
  std::uint64_t rows = 0;        ///< present ones; ignored by add_table
};

/// An open file. Paths of objects begin with '/'. All functions throw std::runtime_error with
/// "cannot <what> <file>: <reason>", a std::system_error if the reason is the system's; a file whose change has failed is
/// not to be used again.
class Hdf5File {
 public:
  enum class Access {
    create,  ///< a new file, or an empty one in place of an old one
    change,
    read,
  };

  /// Files are not locked: a file that others read may be changed.
  Hdf5File(std::filesystem::path path, Access access);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Writes what is pending and closes the file. A file that was changed and is destroyed without it is not to be used:
  /// that is for exceptions on the way.
  void close();

  /// False for a link without target, too.
  [[nodiscard]] bool exists(const std::string& object) const;
  /// Names in a group, in the order in which they were added.
  [[nodiscard]] std::vector<std::string> names_in(const std::string& group) const;

  /// Its parent must exist. Groups keep the order of their members.
  void add_group(const std::string& group);
  /// Another name of the same object.
  void add_name(const std::string& object, const std::string& name);
  void add_soft_link(const std::string& target, const std::string& name);

  /// Attributes of a group; an existing one is replaced. Texts are ASCII of fixed length.
  void set_attribute(const std::string& group, const char* name, std::span<const std::int64_t> values);
  void set_attribute(const std::string& group, const char* name, const std::string& text);
  /// An attribute of one integer.
  [[nodiscard]] std::int64_t integer_attribute(const std::string& group, const char* name) const;
  /// @return at most 64 bytes
  [[nodiscard]] std::string text_attribute(const std::string& group, const char* name) const;

  void add_table(const std::string& table, const Hdf5Table& layout);
  [[nodiscard]] Hdf5Table table(const std::string& table) const;
  /// New rows have NaN (real64, real32), -1 (integers), 0 (unsigned8) or an empty text; others than the first are lost.
  void resize(const std::string& table, std::uint64_t rows);

  /// Makes a table that has the first rows of the other file's equal to it. Compressed chunks are copied as they are.
  void add_rows_of(const Hdf5File& other, const std::string& table);

  /// Rows from `start` on, which are added as far as they do not exist.
  /// @tparam T double, float, std::int32_t, std::int64_t, std::uint8_t or std::string: that of the table
  template <class T>
  void write(const std::string& table, std::uint64_t start, std::span<const T> values);
  /// @throws also if the table has other values or fewer rows. @return (rows x columns)
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& table, std::uint64_t start, std::uint64_t rows) const;

 private:
  [[noreturn]] void fail(const char* action) const;

  std::filesystem::path path_;
  const char* action_;  ///< "read" or "write"
  std::int64_t file_;   ///< identifier of the library, < 0: closed
};

}  // namespace ashlar
