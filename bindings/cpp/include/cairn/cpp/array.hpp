// SPDX-License-Identifier: BSD-3-Clause
// Arrays of the caller: any contiguous container goes in without a copy, and a wrong shape is refused.
#ifndef CAIRN_CPP_ARRAY_HPP
#define CAIRN_CPP_ARRAY_HPP

#include <array>
#include <cairn/cpp/error.hpp>
#include <initializer_list>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace cairn {

/// Values in a row that belong to somebody else.
template <class T>
class Span {
 public:
  constexpr Span() noexcept = default;
  constexpr Span(T* data, std::size_t size) noexcept : data_(data), size_(size) {}
  template <
      class Container,
      class = std::enable_if_t<
          !std::is_same_v<std::decay_t<Container>, Span> &&
          std::is_convertible_v<std::remove_pointer_t<decltype(std::data(std::declval<Container&>()))> (*)[], T (*)[]>>>
  constexpr Span(Container&& container) : Span(std::data(container), static_cast<std::size_t>(std::size(container))) {}

  constexpr T* data() const noexcept { return data_; }
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr T* begin() const noexcept { return data_; }
  constexpr T* end() const noexcept { return data_ + size_; }
  constexpr T& operator[](std::size_t i) const noexcept { return data_[i]; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

namespace detail {

template <class Container, class = void>
struct ElementOf {
  using type = void;
};
template <class Container>
struct ElementOf<Container, std::void_t<decltype(std::data(std::declval<const Container&>())),
                                        decltype(std::size(std::declval<const Container&>()))>> {
  using type = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(std::declval<const Container&>()))>>;
};

/// Number of elements that the type says; -1: known at run time only.
template <class Container, class = void>
inline constexpr long static_size = -1;
template <class T, std::size_t n>
inline constexpr long static_size<T[n], void> = static_cast<long>(n);
template <class T, std::size_t n>
inline constexpr long static_size<std::array<T, n>, void> = static_cast<long>(n);
template <class Container>
inline constexpr long static_size<Container, std::void_t<decltype(Container::SizeAtCompileTime)>> =
    Container::SizeAtCompileTime;  // Eigen; its Dynamic is -1

template <class Container, class = void>
inline constexpr bool is_eigen = false;
template <class Container>
inline constexpr bool
    is_eigen<Container, std::void_t<decltype(Container::IsRowMajor), decltype(Container::RowsAtCompileTime)>> = true;

[[noreturn]] inline void wrong_size(const char* name, std::size_t expected, std::size_t size) {
  throw Error(Status::kErrorArgument, std::string(name) + " must have " + std::to_string(expected) +
                                          " values, and has " + std::to_string(size));
}

}  // namespace detail

/// An array that a call reads: anything with data() and size() (std::vector, std::array, std::span, Eigen), an array of
/// C, or a list in braces. `n` is the number of values, 0: any. `symmetric` is a matrix for which rows and columns are
/// the same.
///
/// It is for parameters: it keeps no copy, so a list in braces is gone after the call.
///
/// All matrices are row-major. A column-major Eigen matrix does not compile, except where it is symmetric. A part of a
/// larger Eigen matrix has gaps between its values and is refused: copy it.
template <class T, std::size_t n = 0, bool symmetric = false>
class Input {
 public:
  constexpr Input() noexcept = default;
  constexpr Input(std::initializer_list<T> list) noexcept : size_(list.size()) {
    data_ = std::data(list);  // the list lives as long as the call
  }
  template <class Container, std::enable_if_t<std::is_same_v<typename detail::ElementOf<Container>::type, T>, int> = 0>
  constexpr Input(const Container& container)
      : data_(std::data(container)), size_(static_cast<std::size_t>(std::size(container))) {
    static_assert(
        n == 0 || detail::static_size<Container> < 0 || detail::static_size<Container> == static_cast<long>(n),
        "cairn: this array has the wrong number of values");
    if constexpr (detail::is_eigen<Container>) {
      static_assert(Container::IsVectorAtCompileTime || Container::IsRowMajor || symmetric,
                    "cairn: matrices are row-major: use Eigen::RowMajor, or copy the matrix into one");
      if (container.innerStride() != 1 ||
          (!Container::IsVectorAtCompileTime && container.outerStride() != container.innerSize()))
        throw Error(Status::kErrorArgument, "a part of a larger Eigen matrix has gaps between its values: copy it");
    }
  }

  constexpr const T* data() const noexcept { return data_; }
  constexpr std::size_t size() const noexcept { return size_; }

  /// The values, after a check of their number.
  constexpr const T* get(const char* name) const { return get(name, n); }
  constexpr const T* get(const char* name, std::size_t expected) const {
    if (size_ != expected) detail::wrong_size(name, expected, size_);
    return data_;
  }
  /// The same, or nullptr where no array was given.
  constexpr const T* get_optional(const char* name) const { return size_ == 0 ? nullptr : get(name); }

 private:
  const T* data_ = nullptr;
  std::size_t size_ = 0;
};

template <std::size_t n>
using Vector = Input<double, n>;
/// A covariance of n x n values, or of any size if n is 0.
template <std::size_t n>
using Symmetric = Input<double, n * n, true>;
/// A row-major matrix of n x n values.
template <std::size_t n>
using Square = std::array<double, n * n>;

namespace detail {

/// Fills a vector by `function(data, capacity, needed, error)` of C. It asks for the size first, so nobody may change
/// the handle meanwhile. An element that is counted has `width` values.
template <class T, class Function>
std::vector<T> fill(Function function, std::size_t width = 1) {
  std::size_t needed = 0;
  call([&](cairn_error* error) {
    return function(as_c_or_same(static_cast<T*>(nullptr)), std::size_t{0}, &needed, error);
  });
  std::vector<T> result(needed * width);
  if (needed != 0)
    call([&](cairn_error* error) { return function(as_c_or_same(result.data()), needed, &needed, error); });
  return result;
}

}  // namespace detail
}  // namespace cairn

#endif
