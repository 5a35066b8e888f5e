// SPDX-License-Identifier: BSD-3-Clause
// One block of memory that is handed out piece by piece when a handle is created. An arena without a block only
// measures: the code that takes the memory also computes beforehand how much it needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace cairn {

class Arena {
 public:
  static constexpr std::size_t kAlignment = 64;  // a cache line

  // Measures only.
  Arena() = default;

  explicit Arena(std::size_t bytes) : bytes_(bytes) {
    // The pages of a large calloc block are not committed before they are used.
    block_ = std::calloc(bytes + kAlignment, 1);
    if (block_ == nullptr) throw std::bad_alloc();
    const auto address = reinterpret_cast<std::uintptr_t>(block_);
    base_ = reinterpret_cast<unsigned char*>((address + kAlignment - 1) / kAlignment * kAlignment);
  }
  ~Arena() { std::free(block_); }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  // `count` objects of a trivial type with all bits zero. Null while measuring.
  template <class T>
  T* take(std::size_t count) {
    const std::size_t start = used_;
    if (count > (SIZE_MAX / 2 - used_) / sizeof(T)) throw std::bad_alloc();
    used_ += (count * sizeof(T) + kAlignment - 1) / kAlignment * kAlignment;
    if (base_ == nullptr) return nullptr;
    if (used_ > bytes_) throw std::bad_alloc();
    return reinterpret_cast<T*>(base_ + start);
  }

  std::size_t used() const { return used_; }
  bool measuring() const { return base_ == nullptr; }

 private:
  void* block_ = nullptr;
  unsigned char* base_ = nullptr;
  std::size_t bytes_ = 0;
  std::size_t used_ = 0;
};

}  // namespace cairn
