// SPDX-License-Identifier: BSD-3-Clause
// Values of C++ from and to the JSON of the conformance scenarios (tests/conformance/README.md).
#ifndef CAIRN_BINDINGS_CPP_TESTS_VALUES_HPP
#define CAIRN_BINDINGS_CPP_TESTS_VALUES_HPP

#include <array>
#include <cstring>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace cairn {
template <class T>
using Constants = std::map<std::string, T>;
}

#include "call.hpp"    // of tests/conformance: numbers and names
#include "fields.hpp"  // generated: constants and fields

namespace replayer {

using conformance::Failure;
using conformance::json;

template <class T>
void read(const json& from, T& to);

template <class T>
T as(const json& from) {
  T result{};
  read(from, result);
  return result;
}

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t n>
inline constexpr bool is_array<std::array<T, n>> = true;

template <class T>
void read_fields(const json& from, T& to) {
  std::size_t found = 0;
  for_each_field(to, [&](const char* name, auto& field, bool) {
    if (!from.contains(name)) return;
    read(from.at(name), field);
    ++found;
  });
  if (found != from.size()) throw Failure("a field is unknown: " + from.dump());
}

template <class T>
void read(const json& from, T& to) {
  if constexpr (std::is_same_v<T, cairn::Bool>) {
    to = from.get<bool>();
  } else if constexpr (std::is_same_v<T, std::vector<std::uint8_t>>) {
    to = conformance::read_bytes(from);
  } else if constexpr (is_vector<T> || is_array<T>) {
    if (!from.is_array()) throw Failure(from.dump() + " is not a list");
    if constexpr (is_vector<T>) to.resize(from.size());
    if (to.size() != from.size()) throw Failure(from.dump() + " has a wrong length");
    for (std::size_t i = 0; i < to.size(); ++i) read(from[i], to[i]);
  } else if constexpr (std::is_enum_v<T>) {
    to = is_bits(T{}) ? static_cast<T>(conformance::read_unsigned(from))
                      : cairn::constants_of(T{}).at(from.get<std::string>());
  } else if constexpr (std::is_class_v<T>) {
    read_fields(from, to);
  } else {
    conformance::read(from, to);
  }
}

template <class T>
json write(const T& value) {
  if constexpr (std::is_same_v<T, cairn::Bool>) {
    return json(static_cast<bool>(value));
  } else if constexpr (std::is_same_v<T, std::vector<std::uint8_t>>) {
    return conformance::write_bytes(value.data(), value.size());
  } else if constexpr (is_vector<T> || is_array<T>) {
    json list = json::array();
    for (const auto& item : value) list.push_back(write(item));
    return list;
  } else if constexpr (std::is_enum_v<T>) {
    if constexpr (is_bits(T{})) {
      conformance::Constants names;
      for (const auto& [name, bit] : cairn::constants_of(T{})) names[static_cast<std::int64_t>(bit)] = name.c_str();
      return conformance::write_bits(static_cast<std::int64_t>(value), names);
    } else {
      return json(cairn::constant_name(value));
    }
  } else if constexpr (std::is_class_v<T>) {
    json object = json::object();
    for_each_field(value, [&](const char* name, const auto& field, bool repeatable) {
      if (repeatable) object[name] = write(field);
    });
    return object;
  } else if constexpr (std::is_same_v<T, double>) {
    return conformance::write_double(value);
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return conformance::write_unsigned(value);
  } else {
    return json(value);
  }
}

}  // namespace replayer

#endif
