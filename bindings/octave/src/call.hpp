// SPDX-License-Identifier: BSD-3-Clause
// One call from Octave: its arguments, its results, its error, and what its callbacks left.
#pragma once

#include <exception>
#include <memory>
#include <optional>

#include "handles.hpp"

namespace cairn_octave {

class Call {
 public:
  Call(std::string name, int outputs, mxArray** results, int inputs, const mxArray* const* arguments)
      : outer_(current),
        name_(std::move(name)),
        outputs_(outputs),
        results_(results),
        inputs_(inputs),
        arguments_(arguments) {
    current = this;
    error.struct_size = sizeof error;
  }
  ~Call() {
    for (Handle* handle : used_) --handle->calls;
    current = outer_;
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  static inline Call* current = nullptr;  // the innermost call: a callback may make calls, too
  cairn_error error{};

  // An error of a callback: an exception of Octave that guarded.m caught, one of ours, or an interrupt.
  mxArray* callback_error = nullptr;
  std::exception_ptr callback_exception;
  std::string log_error;

  // Arguments, in their order. One that is missing is like [].
  const mxArray* next(const char* name, bool optional) {
    const mxArray* value = position_ < inputs_ ? arguments_[position_] : nullptr;
    ++position_;
    if (value && optional && mxIsEmpty(value) && !mxIsChar(value) && !mxIsStruct(value)) return nullptr;
    if (!value && !optional) fail("ARGUMENT", "%s: the argument %s is missing", name_.c_str(), name);
    return value;
  }
  Place place(const char* name) const { return {name_, name}; }

  template <typename T>
  T* handle(const char* name, const HandleType& type) {
    Handle& handle = handles.get(handle_number(name), type, place(name), used_);
    ++handle.calls;
    used_.push_back(&handle);
    return static_cast<T*>(handle.pointer);
  }
  uint64_t handle_number(const char* name) {
    const mxArray* value = next(name, false);
    if (mxGetClassID(value) != mxUINT64_CLASS || mxGetNumberOfElements(value) != 1)
      place(name).wrong("an object of this package", value);
    last_handle_ = *static_cast<const uint64_t*>(mxGetData(value));
    return last_handle_;
  }
  template <typename T>
  T scalar(const char* name) {
    return read_scalar<T>(next(name, false), place(name));
  }
  template <typename T>
  T constant(const char* name, const Enum& constants) {
    return read_constant<T>(next(name, false), constants, place(name));
  }
  std::optional<std::string> text(const char* name, bool optional) {
    const mxArray* value = next(name, optional);
    if (!value) return std::nullopt;
    return read_text(value, place(name));
  }
  // False: it was not given, and `to` stays as it is.
  bool object(const char* name, const Struct& type, void* to, bool optional) {
    const mxArray* value = next(name, optional);
    if (value) read_object(value, type, to, type.size, 1, place(name));
    return value != nullptr;
  }
  template <typename T>
  std::vector<T> objects(const char* name, const Struct& type) {
    return read_objects<T>(next(name, false), type, place(name));
  }
  template <typename T>
  std::vector<T> vector(const char* name) {
    return read_vector<T>(next(name, false), place(name));
  }
  bool matrix(const char* name, double* to, size_t rows, size_t columns, bool optional) {
    const mxArray* value = next(name, optional);
    if (value) read_matrix(value, to, rows, columns, place(name));
    return value != nullptr;
  }
  const mxArray* function(const char* name, bool optional) {
    const mxArray* value = next(name, optional);
    if (value && !mxIsFunctionHandle(value) && !mxIsChar(value)) place(name).wrong("a function handle", value);
    return value;
  }

  // Results, in their order. Octave may ask for fewer.
  bool wanted(int index) const { return index == 0 || index < outputs_; }
  void give(mxArray* value) {
    if (wanted(given_)) results_[given_] = value;
    ++given_;
  }
  void give_owned(const HandleType& type, void* pointer) { give(write_number(handles.add(type, pointer))); }
  void give_lent(const HandleType& type, const void* pointer) {
    give(write_number(handles.add(type, const_cast<void*>(pointer), last_handle_)));
  }

  void check(cairn_status status) {
    if (status == CAIRN_OK) {
      if (!log_error.empty()) mexWarnMsgIdAndTxt("cairn:log", "the function of the log failed: %s", log_error.c_str());
      return;
    }
    if (status == CAIRN_ERROR_CALLBACK && callback_exception) std::rethrow_exception(callback_exception);
    if (status == CAIRN_ERROR_CALLBACK && callback_error) throw callback_error;
    std::string name = cairn_status_name(status);
    const std::string prefix = "CAIRN_ERROR_";
    if (name.rfind(prefix, 0) == 0) name.erase(0, prefix.size());
    throw Failure{"cairn:" + name, error.message};
  }

  static mxArray* write_number(uint64_t value) { return write_ids(&value, 1); }

 private:
  static bool mxIsFunctionHandle(const mxArray* value) { return mxIsClass(value, "function_handle"); }

  Call* outer_;
  std::string name_;
  int outputs_;
  mxArray** results_;
  int inputs_;
  const mxArray* const* arguments_;
  int position_ = 0;
  int given_ = 0;
  uint64_t last_handle_ = 0;
  std::vector<Handle*> used_;
};

}  // namespace cairn_octave
