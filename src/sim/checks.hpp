// SPDX-License-Identifier: BSD-3-Clause
// What the C boundaries of worlds and fleets share beyond that of all libraries.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "capi/boundary.hpp"

namespace cairn::sim {

inline void check_choice(std::int32_t value, std::int32_t last, const char* name, const char* constants) {
  if (value < 0 || value > last)
    throw Error(ErrorCode::argument, "options.%s is %d, none of the %s constants", name, value, constants);
}

// As many bytes of it as the caller's struct has.
template <class Struct>
void write_struct(Struct value, Struct* out, const char* name) {
  capi::check_pointer(out, name);
  const std::uint32_t size = out->struct_size;
  capi::check_struct_size(size, name);
  value.struct_size = size;
  std::memcpy(static_cast<void*>(out), &value, std::min<std::size_t>(size, sizeof value));
}

}  // namespace cairn::sim
