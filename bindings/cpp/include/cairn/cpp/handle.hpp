// SPDX-License-Identifier: BSD-3-Clause
// A handle of C with one owner. A closed handle, and a second thread on a handle, are errors.
#ifndef CAIRN_CPP_HANDLE_HPP
#define CAIRN_CPP_HANDLE_HPP

#include <cairn/map.h>

#include <atomic>
#include <cairn/cpp/array.hpp>
#include <exception>
#include <memory>
#include <string>

namespace cairn {
namespace detail {

[[noreturn]] inline void refuse_closed(const char* kind) {
  throw Error(Status::kErrorState, std::string("this ") + kind + " is closed, or was moved from");
}

/// What the owner of a handle and the maps that it lends share.
struct Guarded {
  explicit Guarded(const char* kind) noexcept : name(kind) {}

  [[noreturn]] void refuse_busy() const {
    throw Error(Status::kErrorState,
                std::string("this ") + name +
                    " is in use by another thread, or by the call that runs this callback: one at a time");
  }
  /// Throws what a callback threw, otherwise the error of the library.
  [[noreturn]] void fail(cairn_status status, const cairn_error& error) {
    if (thrown != nullptr) std::rethrow_exception(std::exchange(thrown, nullptr));
    detail::fail(status, error);
  }

  const char* name;
  std::atomic<int> users{0};  // -1: a call that changes the handle; otherwise the number of queries
  bool open = true;
  std::exception_ptr thrown;  // by a callback of the call that runs
};

/// During a call that changes a handle.
class Changing {
 public:
  explicit Changing(Guarded& guarded) : guarded_(guarded) {
    int nobody = 0;
    if (!guarded.users.compare_exchange_strong(nobody, -1, std::memory_order_acquire)) guarded.refuse_busy();
  }
  Changing(const Changing&) = delete;
  Changing& operator=(const Changing&) = delete;
  ~Changing() { guarded_.users.store(0, std::memory_order_release); }

 private:
  Guarded& guarded_;
};

/// During a query. Queries may run side by side.
class Reading {
 public:
  explicit Reading(Guarded& guarded) : guarded_(guarded) {
    int users = guarded.users.load(std::memory_order_relaxed);
    do {
      if (users < 0) guarded.refuse_busy();
    } while (!guarded.users.compare_exchange_weak(users, users + 1, std::memory_order_acquire));
  }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  ~Reading() { guarded_.users.fetch_sub(1, std::memory_order_release); }

 private:
  Guarded& guarded_;
};

template <class Kind>
struct Shared : Guarded {
  using Handle = typename Kind::Handle;
  Shared() noexcept : Guarded(Kind::name) {}
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  ~Shared() { Kind::destroy(handle); }

  Handle* handle = nullptr;
};

/// The owner of a handle. It can be moved, not copied.
template <class Kind>
class Owner {
 public:
  using Handle = typename Kind::Handle;

  /// Whether the handle is there: not closed, not moved away.
  bool is_open() const noexcept { return shared_ != nullptr && shared_->handle != nullptr; }

  /// Frees the handle now; the destructor does it otherwise. Later calls are errors, a second close() does nothing.
  void close() {
    if (!is_open()) return;
    Changing changing(*shared_);
    shared_->open = false;
    Kind::destroy(std::exchange(shared_->handle, nullptr));
  }

  /// The handle, for calls in C; nullptr if it is closed. It still belongs to this object.
  Handle* c_handle() const noexcept { return shared_ != nullptr ? shared_->handle : nullptr; }

 protected:
  /// `create(Handle**, cairn_error*)`
  template <class Create>
  explicit Owner(Create create) : shared_(std::make_shared<Shared<Kind>>()) {
    require_library();
    call([&](cairn_error* error) { return create(&shared_->handle, error); });
  }
  Owner(Owner&&) noexcept = default;
  Owner& operator=(Owner&&) noexcept = default;
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;
  ~Owner() = default;

  const std::shared_ptr<Shared<Kind>>& shared() const {
    if (!is_open()) refuse_closed(Kind::name);
    return shared_;
  }

  /// Calls `function(handle, arguments..., error)`, which changes the handle.
  template <class Function, class... Arguments>
  void change(Function function, Arguments... arguments) {
    Shared<Kind>& shared = *this->shared();
    Changing changing(shared);
    CallError error;
    const cairn_status status = function(shared.handle, arguments..., &error);
    if (status != CAIRN_OK) shared.fail(status, error);
  }

  /// Calls `function(handle, arguments..., error)`, which only reads.
  template <class Function, class... Arguments>
  void query(Function function, Arguments... arguments) const {
    Shared<Kind>& shared = *this->shared();
    Reading reading(shared);
    CallError error;
    const cairn_status status = function(shared.handle, arguments..., &error);
    if (status != CAIRN_OK) shared.fail(status, error);
  }

  /// The map of C that `function(handle)` lends.
  template <class Function>
  const cairn_map* lend(Function function) const {
    Shared<Kind>& shared = *this->shared();
    Reading reading(shared);
    return function(shared.handle);
  }

  /// The output of a query that has one value.
  template <class T, class Function, class... Arguments>
  T get(Function function, Arguments... arguments) const {
    T result{};
    query(function, arguments..., as_c_or_same(&result));
    return result;
  }

  /// The array that `function(handle, arguments..., data, capacity, needed, error)` gives.
  template <class T, class Function, class... Arguments>
  std::vector<T> list(Function function, Arguments... arguments) const {
    return list_of_rows<T>(1, function, arguments...);
  }
  template <class T, class Function, class... Arguments>
  std::vector<T> list_of_rows(std::size_t width, Function function, Arguments... arguments) const {
    Shared<Kind>& shared = *this->shared();
    Reading reading(shared);
    return fill<T>(
        [&](auto* data, std::size_t capacity, std::size_t* needed, cairn_error* error) {
          return function(shared.handle, arguments..., data, capacity, needed, error);
        },
        width);
  }

 private:
  std::shared_ptr<Shared<Kind>> shared_;
};

}  // namespace detail
}  // namespace cairn

#endif
