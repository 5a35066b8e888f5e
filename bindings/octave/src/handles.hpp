// SPDX-License-Identifier: BSD-3-Clause
// The handles of the library. Octave knows them by numbers, which are never used again: a closed handle is an error.
#pragma once

#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "values.hpp"

namespace cairn_octave {

struct HandleType {
  const char* name;
  void (*destroy)(void*);
};

struct Handle {
  const HandleType* type;
  void* pointer;
  uint64_t owner;  // of a map that a filter or a team lends; 0: Octave owns the handle
  int calls;       // that run now
};

class Handles {
 public:
  uint64_t add(const HandleType& type, void* pointer, uint64_t owner = 0) {
    if (owner)
      for (auto& [number, handle] : all_)
        if (handle.owner == owner && handle.pointer == pointer) return number;
    all_.emplace(++last_, Handle{&type, pointer, owner, 0});
    return last_;
  }

  // A callback runs inside a call of its handle, and must not use this handle. `own`: handles of the call that asks.
  Handle& get(uint64_t number, const HandleType& type, const Place& place, const std::vector<Handle*>& own) {
    const auto found = all_.find(number);
    if (found == all_.end()) fail("STATE", "%s: the %s is closed", place.call.c_str(), type.name);
    Handle& handle = found->second;
    if (handle.type != &type)
      fail("ARGUMENT", "%s: %s must be a %s, and is a %s", place.call.c_str(), place.name.c_str(), type.name,
           handle.type->name);
    if (std::find(own.begin(), own.end(), &handle) == own.end()) refuse_busy(handle, place.call);
    return handle;
  }

  // A handle that is closed already, or that another handle lends, is left alone.
  void close(uint64_t number) {
    const auto found = all_.find(number);
    if (found == all_.end() || found->second.owner) return;
    refuse_busy(found->second, "close");
    const Handle handle = found->second;
    for (auto it = all_.begin(); it != all_.end();)
      it = it->first == number || it->second.owner == number ? all_.erase(it) : std::next(it);
    handle.type->destroy(handle.pointer);
  }

  bool open(uint64_t number) const { return all_.count(number) != 0; }

  void close_all() {
    while (!all_.empty()) {
      const Handle handle = all_.begin()->second;
      all_.erase(all_.begin());
      if (!handle.owner) handle.type->destroy(handle.pointer);
    }
  }

 private:
  void refuse_busy(const Handle& handle, const std::string& call) const {
    const auto owner = all_.find(handle.owner);
    if (handle.calls > 0 || (owner != all_.end() && owner->second.calls > 0))
      fail("STATE", "%s: the %s is in use: a callback must not use the handle that calls it", call.c_str(),
           handle.type->name);
  }

  std::unordered_map<uint64_t, Handle> all_;
  uint64_t last_ = 0;
};

inline Handles handles;

}  // namespace cairn_octave
