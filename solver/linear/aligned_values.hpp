// Arrays of numbers that begin at a cache line, with values that are not initialised.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace ashlar {

template <class T>
class AlignedValues {
 public:
  AlignedValues() = default;
  /// @throws std::bad_alloc
  explicit AlignedValues(std::size_t size)
      : values_(static_cast<T*>(::operator new(size * sizeof(T), line))), size_(size) {}

  [[nodiscard]] T* data() const { return values_.get(); }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  static constexpr std::align_val_t line{64};
  struct Free {
    void operator()(T* values) const { ::operator delete(values, line); }
  };
  std::unique_ptr<T, Free> values_;
  std::size_t size_ = 0;
};

}  // namespace ashlar
