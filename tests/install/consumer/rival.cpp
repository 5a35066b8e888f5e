// SPDX-License-Identifier: BSD-3-Clause
// Somebody else's C++ in one program with libcairn.a: a class of the same name as one inside the library, and an own
// version of a template that the library instantiates too. Neither may be called by the library, nor stop the linking.
#include <cstdlib>
#include <vector>

namespace cairn {
namespace capi {
const char* last_message() noexcept { std::abort(); }
void set_message(const char*) noexcept { std::abort(); }
}  // namespace capi
}  // namespace cairn

template <>
void std::vector<double>::resize(std::size_t) {
  std::abort();
}

std::vector<int> rival_numbers(int count) {
  std::vector<int> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}
