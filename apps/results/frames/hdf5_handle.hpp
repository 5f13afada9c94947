// Objects and messages of the HDF5 library. Not part of an interface: it includes the library's header.
#pragma once

#include <hdf5.h>

#include <string>
#include <string_view>
#include <utility>

namespace ashlar {

/// An identifier of the library, closed at the end of its scope. What the library still has to write is written when an
/// object is closed: one that has been changed is closed by close(), whose result counts.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  /// @return false if what was pending cannot be written
  [[nodiscard]] bool close() { return close_(std::exchange(id_, -1)) >= 0; }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): an argument of the library

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The library prints no errors within this scope, and does again afterwards if it did.
class Hdf5Quiet {
 public:
  Hdf5Quiet() {
    // At the end of a program the library would write what it could not write before, and crash.
    [[maybe_unused]] static const herr_t ends_without = H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Hdf5Quiet(const Hdf5Quiet&) = delete;
  Hdf5Quiet& operator=(const Hdf5Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// The cause of the last failure: the system's reason if there is one, otherwise the innermost description.
[[nodiscard]] inline std::string last_hdf5_reason() {
  std::string found;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned depth, const H5E_error2_t* error, void* text) -> herr_t {
        if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
        return 0;
      },
      &found);
  constexpr std::string_view mark = "error message = '";
  if (const std::size_t start = found.find(mark); start != std::string::npos)
    found = found.substr(start + mark.size(), found.find('\'', start + mark.size()) - start - mark.size());
  return found.empty() ? "unknown reason" : found;
}

}  // namespace ashlar
