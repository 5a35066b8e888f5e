// SPDX-License-Identifier: BSD-3-Clause
// Helpers that the C boundaries of worlds and fleets share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "capi/boundary.hpp"

namespace cairn::sim {

inline void check_choice(std::int32_t value, std::int32_t last, const char* name, const char* constants) {
  if (value < 0 || value > last)
    throw Error(ErrorCode::argument, "options.%s = %d is none of the %s constants; use one of them", name, value,
                constants);
}

// Writes at most as many bytes of `value` as the caller's struct has.
template <class Struct>
void write_struct(Struct value, Struct* out, const char* name) {
  capi::check_pointer(out, name);
  const std::uint32_t size = out->struct_size;
  capi::check_struct_size(size, name);
  value.struct_size = size;
  std::memcpy(static_cast<void*>(out), &value, std::min<std::size_t>(size, sizeof value));
}

// Copies an array to the caller's buffer.
template <class Element>
void write_array(const Element* elements, std::size_t count, Element* out, std::size_t capacity, std::size_t* needed,
                 const char* name) {
  if (capi::check_room(out, capacity, count, needed, name)) std::copy_n(elements, count, out);
}

// Hands out the next step of a world or a fleet. A bad `step` is refused before the simulation moves.
template <class Simulation, class Step>
void write_next_step(Simulation& simulation, Step* step) {
  capi::check_pointer(step, "step");
  capi::check_struct_size(step->struct_size, "step");
  Step value = {};
  simulation.next(value);
  write_struct(value, step, "step");
}

}  // namespace cairn::sim
