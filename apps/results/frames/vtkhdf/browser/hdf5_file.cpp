// A page is made without the HDF5 library: frames are .vtu files there.
#include "apps/results/frames/vtkhdf/hdf5_file.hpp"

#include <stdexcept>

namespace ashlar {
namespace {

[[noreturn]] void refuse() {
  throw std::runtime_error("a browser has no HDF5 library: frames are written with output.format = \"vtu\"");
}

}  // namespace

Hdf5File::Hdf5File(std::filesystem::path /*path*/, Access /*access*/) {
  refuse();
}

Hdf5File::~Hdf5File() = default;

// No object exists: nothing below is called.
void Hdf5File::close() {}

bool Hdf5File::exists(const std::string& /*object*/) const {
  refuse();
}

std::vector<std::string> Hdf5File::names_in(const std::string& /*group*/) const {
  refuse();
}

void Hdf5File::add_group(const std::string& /*group*/) {
  refuse();
}

void Hdf5File::add_name(const std::string& /*object*/, const std::string& /*name*/) {
  refuse();
}

void Hdf5File::add_soft_link(const std::string& /*target*/, const std::string& /*name*/) {
  refuse();
}

void Hdf5File::set_attribute(const std::string& /*group*/, const char* /*name*/,
                             std::span<const std::int64_t> /*values*/) {
  refuse();
}

void Hdf5File::set_attribute(const std::string& /*group*/, const char* /*name*/,
                             const std::string& /*text*/) {
  refuse();
}

std::int64_t Hdf5File::integer_attribute(const std::string& /*group*/, const char* /*name*/) const {
  refuse();
}

std::string Hdf5File::text_attribute(const std::string& /*group*/, const char* /*name*/) const {
  refuse();
}

void Hdf5File::add_table(const std::string& /*table*/, const Hdf5Table& /*layout*/) {
  refuse();
}

Hdf5Table Hdf5File::table(const std::string& /*table*/) const {
  refuse();
}

void Hdf5File::resize(const std::string& /*table*/, std::uint64_t /*rows*/) {
  refuse();
}

void Hdf5File::add_rows_of(const Hdf5File& /*other*/, const std::string& /*table*/) {
  refuse();
}

template <class T>
void Hdf5File::write(const std::string& /*table*/, std::uint64_t /*start*/, std::span<const T> /*values*/) {
  refuse();
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& /*table*/, std::uint64_t /*start*/,
                              std::uint64_t /*rows*/) const {
  refuse();
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
