#include "apps/results/frames/vtkhdf/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <type_traits>
#include <utility>

#include "apps/results/frames/vtkhdf/hdf5_handle.hpp"

namespace ashlar {
namespace {

// Coordinates and forces hardly compress: level 4 takes half as long again for one per cent.
constexpr unsigned compression_level = 1;

hid_t new_file_type(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::real64:
      return H5Tcopy(H5T_IEEE_F64LE);
    case Hdf5Type::real32:
      return H5Tcopy(H5T_IEEE_F32LE);
    case Hdf5Type::integer32:
      return H5Tcopy(H5T_STD_I32LE);
    case Hdf5Type::integer64:
      return H5Tcopy(H5T_STD_I64LE);
    case Hdf5Type::unsigned8:
      return H5Tcopy(H5T_STD_U8LE);
    case Hdf5Type::text:
      break;
  }
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, H5T_VARIABLE);
  return text;
}

constexpr std::array all_types = {Hdf5Type::real64,    Hdf5Type::real32,    Hdf5Type::integer32,
                                  Hdf5Type::integer64, Hdf5Type::unsigned8, Hdf5Type::text};

template <class T>
constexpr Hdf5Type type_of = std::is_same_v<T, double>         ? Hdf5Type::real64
                             : std::is_same_v<T, float>        ? Hdf5Type::real32
                             : std::is_same_v<T, std::int32_t> ? Hdf5Type::integer32
                             : std::is_same_v<T, std::int64_t> ? Hdf5Type::integer64
                             : std::is_same_v<T, std::uint8_t> ? Hdf5Type::unsigned8
                                                               : Hdf5Type::text;

void set_fill(hid_t creation, Hdf5Type type) {
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  const std::int64_t no_index = -1;
  if (type == Hdf5Type::real64 || type == Hdf5Type::real32)
    H5Pset_fill_value(creation, H5T_NATIVE_DOUBLE, &no_number);
  if (type == Hdf5Type::integer32 || type == Hdf5Type::integer64)
    H5Pset_fill_value(creation, H5T_NATIVE_INT64, &no_index);
}

/// Values in memory as the library passes them.
template <class T>
using Passed = std::conditional_t<std::is_same_v<T, std::string>, const char*, T>;

/// The rows of a table in the file, selected.
hid_t selected_rows(hid_t dataset, const Hdf5Table& layout, std::uint64_t start, std::uint64_t rows) {
  const hid_t space = H5Dget_space(dataset);
  const std::array<hsize_t, 2> from = {start, 0};
  const std::array<hsize_t, 2> count = {rows, static_cast<hsize_t>(layout.columns)};
  if (space >= 0) H5Sselect_hyperslab(space, H5S_SELECT_SET, from.data(), nullptr, count.data(), nullptr);
  return space;
}

std::uint64_t values_of_row(const Hdf5Table& layout) {
  return static_cast<std::uint64_t>(std::max(layout.columns, 1));
}

}  // namespace

void Hdf5File::fail(const char* action) const {
  const Hdf5Reason reason = last_hdf5_reason();
  const std::string what = fmt::format("cannot {} {}", action, path_.string());
  if (reason.system != 0) throw std::system_error(reason.system, std::generic_category(), what);
  throw std::runtime_error(fmt::format("{}: {}", what, reason.text));
}

Hdf5File::Hdf5File(std::filesystem::path path, Access access)
    : path_(std::move(path)), action_(access == Access::read ? "read" : "write"), file_(-1) {
  const Hdf5Quiet quiet;
  const Hdf5Handle opening(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // The format of HDF5 1.10 has the smaller indices of chunks.
  H5Pset_libver_bounds(opening, H5F_LIBVER_V110, H5F_LIBVER_V110);
  H5Pset_file_locking(opening, false, true);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(creation, false);
  if (access == Access::create)
    file_ = H5Fcreate(path_.string().c_str(), H5F_ACC_TRUNC, creation, opening);
  else
    file_ = H5Fopen(path_.string().c_str(), access == Access::read ? H5F_ACC_RDONLY : H5F_ACC_RDWR, opening);
  if (file_ < 0) fail(access == Access::read ? "read" : "open");
}

Hdf5File::~Hdf5File() {
  if (file_ < 0) return;
  const Hdf5Quiet quiet;
  H5Fclose(file_);
}

void Hdf5File::close() {
  const Hdf5Quiet quiet;
  if (H5Fclose(std::exchange(file_, -1)) < 0) fail(action_);
}

bool Hdf5File::exists(const std::string& object) const {
  const Hdf5Quiet quiet;
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    const std::string part = object.substr(0, end);
    if (H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0 ||
        H5Oexists_by_name(file_, part.c_str(), H5P_DEFAULT) <= 0)
      return false;
    if (end == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5File::names_in(const std::string& group) const {
  const Hdf5Quiet quiet;
  const Hdf5Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t information;
  if (opened < 0 || H5Gget_info(opened, &information) < 0) fail(action_);
  std::vector<std::string> names;
  for (hsize_t k = 0; k < information.nlinks; ++k) {
    std::array<char, 256> name{};
    const ssize_t length = H5Lget_name_by_idx(opened, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, k, name.data(),
                                              name.size(), H5P_DEFAULT);
    if (length < 0) fail(action_);
    names.emplace_back(name.data());
  }
  return names;
}

void Hdf5File::add_group(const std::string& group) {
  const Hdf5Quiet quiet;
  const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(creation, false);
  Hdf5Handle added(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
  if (added < 0 || !added.close()) fail(action_);
}

void Hdf5File::add_name(const std::string& object, const std::string& name) {
  const Hdf5Quiet quiet;
  if (H5Lcreate_hard(file_, object.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0) fail(action_);
}

void Hdf5File::add_soft_link(const std::string& target, const std::string& name) {
  const Hdf5Quiet quiet;
  if (H5Lcreate_soft(target.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0) fail(action_);
}

void Hdf5File::set_attribute(const std::string& group, const char* name,
                             std::span<const std::int64_t> values) {
  const Hdf5Quiet quiet;
  const hsize_t size = values.size();
  Hdf5Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  const Hdf5Handle space(size == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr), H5Sclose);
  const bool known = H5Aexists(opened, name) > 0;
  Hdf5Handle attribute(known ? H5Aopen(opened, name, H5P_DEFAULT)
                             : H5Acreate2(opened, name, H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT),
                       H5Aclose);
  if (attribute < 0 || H5Awrite(attribute, H5T_NATIVE_INT64, values.data()) < 0 || !attribute.close() ||
      !opened.close())
    fail(action_);
}

void Hdf5File::set_attribute(const std::string& group, const char* name, const std::string& text) {
  const Hdf5Quiet quiet;
  Hdf5Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, text.size());
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  Hdf5Handle attribute(H5Acreate2(opened, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (attribute < 0 || H5Awrite(attribute, type, text.data()) < 0 || !attribute.close() || !opened.close())
    fail(action_);
}

std::int64_t Hdf5File::integer_attribute(const std::string& group, const char* name) const {
  const Hdf5Quiet quiet;
  const Hdf5Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  const Hdf5Handle attribute(H5Aopen(opened, name, H5P_DEFAULT), H5Aclose);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
  std::int64_t value = 0;
  if (space < 0 || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Aread(attribute, H5T_NATIVE_INT64, &value) < 0)
    fail(action_);
  return value;
}

std::string Hdf5File::text_attribute(const std::string& group, const char* name) const {
  const Hdf5Quiet quiet;
  const Hdf5Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  const Hdf5Handle attribute(H5Aopen(opened, name, H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose);
  std::array<char, 65> text{};
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
  if (type < 0 || space < 0 || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
      H5Tget_size(type) >= text.size() || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Aread(attribute, type, text.data()) < 0)
    fail(action_);
  return text.data();
}

void Hdf5File::add_table(const std::string& table, const Hdf5Table& layout) {
  const Hdf5Quiet quiet;
  const int dimensions = layout.columns == 0 ? 1 : 2;
  const std::array<hsize_t, 2> size = {0, static_cast<hsize_t>(layout.columns)};
  const std::array<hsize_t, 2> most = {H5S_UNLIMITED, size[1]};
  const std::array<hsize_t, 2> chunk = {layout.chunk_rows, size[1]};
  const Hdf5Handle space(H5Screate_simple(dimensions, size.data(), most.data()), H5Sclose);
  const Hdf5Handle type(new_file_type(layout.type), H5Tclose);
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(creation, dimensions, chunk.data());
  H5Pset_obj_track_times(creation, false);
  set_fill(creation, layout.type);
  if (layout.compressed) {
    H5Pset_shuffle(creation);
    H5Pset_deflate(creation, compression_level);
  }
  Hdf5Handle added(H5Dcreate2(file_, table.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                   H5Dclose);
  if (added < 0 || !added.close()) fail(action_);
}

Hdf5Table Hdf5File::table(const std::string& table) const {
  const Hdf5Quiet quiet;
  const Hdf5Handle dataset(H5Dopen2(file_, table.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (dataset < 0 || space < 0 || type < 0 || creation < 0) fail(action_);
  Hdf5Table layout;
  const auto* known = std::find_if(all_types.begin(), all_types.end(), [&](Hdf5Type candidate) {
    const Hdf5Handle of_file(new_file_type(candidate), H5Tclose);
    return H5Tequal(type, of_file) > 0;
  });
  const int dimensions = H5Sget_simple_extent_ndims(space);
  std::array<hsize_t, 2> size{}, chunk{};
  if (known == all_types.end() || dimensions < 1 || dimensions > 2 ||
      H5Sget_simple_extent_dims(space, size.data(), nullptr) < 0 || H5Pget_layout(creation) != H5D_CHUNKED ||
      H5Pget_chunk(creation, dimensions, chunk.data()) != dimensions || size[1] > 64)
    throw std::runtime_error(fmt::format("cannot {} {}: {} is no table", action_, path_.string(), table));
  layout.type = *known;
  layout.columns = static_cast<int>(size[1]);
  layout.chunk_rows = chunk[0];
  layout.rows = size[0];
  layout.compressed = H5Pget_nfilters(creation) > 0;
  return layout;
}

void Hdf5File::resize(const std::string& table, std::uint64_t rows) {
  const Hdf5Table layout = this->table(table);
  const Hdf5Quiet quiet;
  Hdf5Handle dataset(H5Dopen2(file_, table.c_str(), H5P_DEFAULT), H5Dclose);
  const std::array<hsize_t, 2> size = {rows, static_cast<hsize_t>(layout.columns)};
  if (dataset < 0 || (layout.rows != rows && H5Dset_extent(dataset, size.data()) < 0) || !dataset.close())
    fail(action_);
}

void Hdf5File::add_rows_of(const Hdf5File& other, const std::string& table) {
  const Hdf5Table old = this->table(table), whole = other.table(table);
  if (old.type == Hdf5Type::text) {
    const std::uint64_t rows = whole.rows - std::min(old.rows, whole.rows);
    write<std::string>(table, old.rows, other.read<std::string>(table, old.rows, rows));
    return;
  }
  resize(table, whole.rows);
  const Hdf5Quiet quiet;
  const Hdf5Handle from(H5Dopen2(other.file_, table.c_str(), H5P_DEFAULT), H5Dclose);
  Hdf5Handle to(H5Dopen2(file_, table.c_str(), H5P_DEFAULT), H5Dclose);
  std::vector<std::uint8_t> chunk;
  for (std::uint64_t row = old.rows / old.chunk_rows * old.chunk_rows; row < whole.rows;
       row += old.chunk_rows) {
    const std::array<hsize_t, 2> place = {row, 0};
    hsize_t bytes = 0;
    std::uint32_t filters = 0;
    if (H5Dget_chunk_storage_size(from, place.data(), &bytes) < 0) fail("read");
    if (bytes == 0) continue;  // never written
    chunk.resize(bytes);
    if (H5Dread_chunk(from, H5P_DEFAULT, place.data(), &filters, chunk.data()) < 0) fail("read");
    if (H5Dwrite_chunk(to, H5P_DEFAULT, filters, place.data(), bytes, chunk.data()) < 0) fail(action_);
  }
  if (!to.close()) fail(action_);
}

template <class T>
void Hdf5File::write(const std::string& table, std::uint64_t start, std::span<const T> values) {
  const Hdf5Table layout = this->table(table);
  const std::uint64_t rows = values.size() / values_of_row(layout);
  if (start + rows > layout.rows) resize(table, start + rows);
  if (rows == 0) return;
  const Hdf5Quiet quiet;
  Hdf5Handle dataset(H5Dopen2(file_, table.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle place(selected_rows(dataset, layout, start, rows), H5Sclose);
  const hsize_t count = values.size();
  const Hdf5Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Hdf5Handle type(new_file_type(type_of<T>), H5Tclose);
  const std::vector<Passed<T>> texts = [&] {
    std::vector<Passed<T>> passed;
    if constexpr (std::is_same_v<T, std::string>)
      for (const T& value : values) passed.push_back(value.c_str());
    return passed;
  }();
  const void* data = std::is_same_v<T, std::string> ? static_cast<const void*>(texts.data())
                                                    : static_cast<const void*>(values.data());
  if (layout.type != type_of<T> || H5Dwrite(dataset, type, memory, place, H5P_DEFAULT, data) < 0 ||
      !dataset.close())
    fail(action_);
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& table, std::uint64_t start, std::uint64_t rows) const {
  const Hdf5Table layout = this->table(table);
  if (layout.type != type_of<T> || start > layout.rows || rows > layout.rows - start) {
    throw std::runtime_error(
        fmt::format("cannot {} {}: {} has {} rows or another type, {} rows from {} on are needed", action_,
                    path_.string(), table, layout.rows, rows, start));
  }
  if (rows == 0) return {};
  const Hdf5Quiet quiet;
  const Hdf5Handle dataset(H5Dopen2(file_, table.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle place(selected_rows(dataset, layout, start, rows), H5Sclose);
  const hsize_t count = rows * values_of_row(layout);
  const Hdf5Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Hdf5Handle type(new_file_type(type_of<T>), H5Tclose);
  std::vector<Passed<T>> passed(count);
  if (H5Dread(dataset, type, memory, place, H5P_DEFAULT, passed.data()) < 0) fail(action_);
  if constexpr (std::is_same_v<T, std::string>) {
    std::vector<std::string> texts;
    for (const char* text : passed) texts.emplace_back(text == nullptr ? "" : text);
    H5Dvlen_reclaim(type, memory, H5P_DEFAULT, passed.data());
    return texts;
  } else {
    return passed;
  }
}

template void Hdf5File::write(const std::string&, std::uint64_t, std::span<const double>);
template void Hdf5File::write(const std::string&, std::uint64_t, std::span<const float>);
template void Hdf5File::write(const std::string&, std::uint64_t, std::span<const std::int32_t>);
template void Hdf5File::write(const std::string&, std::uint64_t, std::span<const std::int64_t>);
template void Hdf5File::write(const std::string&, std::uint64_t, std::span<const std::uint8_t>);
template void Hdf5File::write(const std::string&, std::uint64_t, std::span<const std::string>);
template std::vector<double> Hdf5File::read(const std::string&, std::uint64_t, std::uint64_t) const;
template std::vector<float> Hdf5File::read(const std::string&, std::uint64_t, std::uint64_t) const;
template std::vector<std::int32_t> Hdf5File::read(const std::string&, std::uint64_t, std::uint64_t) const;
template std::vector<std::int64_t> Hdf5File::read(const std::string&, std::uint64_t, std::uint64_t) const;
template std::vector<std::uint8_t> Hdf5File::read(const std::string&, std::uint64_t, std::uint64_t) const;
template std::vector<std::string> Hdf5File::read(const std::string&, std::uint64_t, std::uint64_t) const;

}  // namespace ashlar
