// SPDX-License-Identifier: BSD-3-Clause
// What the generated types are made of.
#ifndef CAIRN_CPP_BASIC_HPP
#define CAIRN_CPP_BASIC_HPP

#include <cairn/status.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

// The types of C++ have the bytes of those of C, and the library reads them as such. The attribute tells the optimiser,
// which sees both sides where the library is linked statically.
#if defined(__GNUC__)
#define CAIRN_CPP_SAME_BYTES [[gnu::may_alias]]
#else
#define CAIRN_CPP_SAME_BYTES
#endif

namespace cairn {

/// A yes or no with the layout of cairn_bool. It converts from and to bool, and from nothing else.
class Bool {
 public:
  constexpr Bool() noexcept = default;
  template <class T, std::enable_if_t<std::is_same_v<T, bool>, int> = 0>
  constexpr Bool(T value) noexcept : value_(value ? 1 : 0) {}
  constexpr operator bool() const noexcept { return value_ != 0; }

 private:
  cairn_bool value_ = 0;
};

namespace detail {

template <class T, class C>
inline constexpr bool same_layout =
    sizeof(T) == sizeof(C) &&
    alignof(T) == alignof(C) && std::is_trivially_copyable_v<T>&& std::is_standard_layout_v<T>;

void require_library();

/// The struct of C with the same bytes.
template <class T>
auto* as_c(T* object) noexcept {
  using C = typename std::remove_const_t<T>::C;
  return reinterpret_cast<std::conditional_t<std::is_const_v<T>, const C, C>*>(object);
}

/// The same for an output that may also be a number.
template <class T>
auto* as_c_or_same(T* object) noexcept {
  if constexpr (std::is_class_v<T>) {
    return as_c(object);
  } else {
    return object;
  }
}

template <class C, class T>
void fill_defaults(T& options, cairn_status (*init)(C*, std::size_t, cairn_error*)) {
  require_library();
  init(as_c(&options), sizeof(C), nullptr);  // fails only for NULL
}

}  // namespace detail
}  // namespace cairn

#endif
