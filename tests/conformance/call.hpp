/* SPDX-License-Identifier: BSD-3-Clause */
/* One call of a scenario: its inputs as C values, its outputs as JSON. The generated dispatch uses nothing else. */
#ifndef CAIRN_TESTS_CONFORMANCE_CALL_HPP
#define CAIRN_TESTS_CONFORMANCE_CALL_HPP

#include <cairn/cairn.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "callbacks.hpp"

namespace conformance {

using nlohmann::json;

/* The scenario cannot be replayed: a mistake of its file, or a failure of the library that it does not expect. */
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Constants = std::map<int64_t, const char*>;      /* names of one type of constants */
const std::map<std::string, int64_t>& all_constants(); /* generated */

/* --- from JSON --- */

double read_double(const json& from);
int64_t read_signed(const json& from);
uint64_t read_unsigned(const json& from);

inline void read(const json& from, double& to) {
  to = read_double(from);
}
inline void read(const json& from, int32_t& to) {
  to = static_cast<int32_t>(read_signed(from));
}
inline void read(const json& from, uint32_t& to) {
  to = static_cast<uint32_t>(read_unsigned(from));
}
inline void read(const json& from, uint64_t& to) {
  to = read_unsigned(from);
}

template <class T, size_t n>
void read(const json& from, T (&to)[n]) {
  if (!from.is_array() || from.size() != n) throw Failure(from.dump() + " is not a list of " + std::to_string(n));
  for (size_t i = 0; i < n; ++i) read(from[i], to[i]);
}

/* A list that was given is never NULL, also if it is empty. */
template <class T>
const T* data_of(const std::optional<std::vector<T>>& list) {
  static const T nothing = {};
  return !list ? nullptr : list->empty() ? &nothing : list->data();
}

/* The generated dispatch has read() and defaults() of each struct. defaults() does what `_init` does, or sets zeros,
   and sets struct_size. */

/* --- to JSON --- */

json write_double(double value);
inline json write_integer(int64_t value) {
  return value;
}
inline json write_bool(int64_t value) {
  return value == 0 || value == 1 ? json(value == 1) : json(value);
}
inline json write_unsigned(uint64_t value) {
  return std::to_string(value);
}
json write_constant(int64_t value, const Constants& names);
json write_bits(int64_t value, const Constants& names);
json write_bytes(const uint8_t* from, size_t count);
std::vector<uint8_t> read_bytes(const json& from);

template <class T, class Write>
json write_list(const T* from, size_t count, Write write) {
  json list = json::array();
  for (size_t i = 0; i < count; ++i) list.push_back(write(from[i]));
  return list;
}

/* --- what a scenario owns --- */

class Scenario {
 public:
  Scenario() = default;
  Scenario(const Scenario&) = delete;
  ~Scenario();

  /* `value` with each "$name" in it replaced by the output of this name. A handle keeps its name. */
  json resolved(const json& value) const;

  void set_name(const std::string& name, json value) { names_[name] = std::move(value); }
  void set_handle(const std::string& name, const void* handle);
  void* handle(const json& name) const;

  using Destroy = void (*)(void*);
  void own(void* handle, Destroy destroy) { owned_.emplace_back(handle, destroy); }
  void destroyed(const void* handle);

  /* Destroys what is left, newest first, and checks that every callback was released once. */
  void end();

  Payload* payload(const Payload& from);
  void lent(Payload* payload) { lent_.insert(payload); }
  std::vector<std::string> take_lines();

 private:
  std::map<std::string, json> names_;
  std::map<std::string, const void*> handles_;
  std::vector<std::pair<void*, Destroy>> owned_;
  std::vector<std::unique_ptr<Payload>> payloads_;
  std::set<const Payload*> lent_; /* those that the library has to release */
  std::vector<std::string> lines_;
};

/* --- one call --- */

class Call {
 public:
  Call(Scenario& scenario, const json& entry);

  template <class T>
  T* handle(const char* name) {
    return static_cast<T*>(scenario_.handle(input(name)));
  }

  template <class T>
  T value(const char* name) {
    T result{};
    read(input(name), result);
    return result;
  }

  std::string text(const char* name) { return input(name).get<std::string>(); }

  /* A struct that is an input, or none. */
  template <class T>
  std::optional<T> object(const char* name, bool optional) {
    if (optional && !has(name)) return std::nullopt;
    T result;
    defaults(result);
    read(input(name), result);
    return result;
  }

  /* A list that is an input; none if it is optional and missing. */
  template <class T>
  std::optional<std::vector<T>> list(const char* name, bool optional) {
    if (optional && !has(name)) return std::nullopt;
    const json& from = input(name);
    if constexpr (std::is_same_v<T, uint8_t>) {
      return read_bytes(from);
    } else {
      if (!from.is_array()) throw Failure(std::string(name) + " is not a list");
      std::vector<T> result(from.size());
      for (size_t i = 0; i < from.size(); ++i) {
        if constexpr (std::is_class_v<T>) defaults(result[i]);
        read(from[i], result[i]);
      }
      return result;
    }
  }

  /* A list whose length follows from another one. */
  void expect_size(const char* name, size_t size, size_t expected) const;

  cairn_custom_predict_fn predict(const char* name);
  cairn_custom_place_fn place(const char* name);
  cairn_log_fn log(const char* name);
  void* payload();
  cairn_release_fn release();

  /* The result of the function. True: it succeeded, and its outputs may be read. */
  bool finish(cairn_status status, const char* last_message);
  void give(const char* name, json value) { gives[name] = std::move(value); }
  void give_created(const char* name, void* handle, Scenario::Destroy destroy);
  void give_lent(const char* name, const void* handle);
  void destroyed(const void* handle) { scenario_.destroyed(handle); }

  /* Fails if an input was not read, or an output that the scenario names was not given. */
  void end() const;

  cairn_error error = {};
  json gives = json::object();
  cairn_status status = CAIRN_OK;

 private:
  bool has(const char* name) const { return inputs_.contains(name); }
  const json& input(const char* name);
  std::string handle_name(const char* output) const;

  Scenario& scenario_;
  const json& entry_;
  json inputs_;
  std::set<std::string> used_;
  Payload* payload_ = nullptr;
  bool releases_ = false;
};

using Function = void (*)(Call&);
const std::map<std::string, Function>& functions(); /* generated */
const char* status_text(cairn_status status);       /* generated: the name of the constant */

}  // namespace conformance

#endif
