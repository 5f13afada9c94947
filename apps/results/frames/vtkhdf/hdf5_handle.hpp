// Objects and messages of the HDF5 library. Not part of an interface: it includes the library's header.
#pragma once

#include <hdf5.h>

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
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

/// The cause of the last failure.
struct Hdf5Reason {
  int system = 0;    ///< number of the system's reason (errno); 0: there is none
  std::string text;  ///< the innermost description, of a failure without the system's reason
};

[[nodiscard]] inline Hdf5Reason last_hdf5_reason() {
  std::string found;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned depth, const H5E_error2_t* error, void* text) -> herr_t {
        if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
        return 0;
      },
      &found);
  // "file write failed: ..., errno = 28, error message = 'No space left on device', ..."
  constexpr std::string_view mark = ", errno = ";
  const std::size_t start = found.rfind(mark);
  int system = 0;
  if (start != std::string::npos) {
    const char* const digits = found.data() + start + mark.size();
    if (std::from_chars(digits, found.data() + found.size(), system).ec != std::errc()) system = 0;
  }
  return {system, found.empty() ? "unknown reason" : found};
}

}  // namespace ashlar
