// SPDX-License-Identifier: BSD-3-Clause
// Functions of Octave that the library calls. guarded.m catches what they throw; nothing unwinds through the library.
#pragma once

#include <algorithm>
#include <initializer_list>

#include "call.hpp"

namespace cairn_octave {

using Functions = std::initializer_list<const mxArray*>;

// The functions of one sensor, or of one log, in the order in which the description names them.
class Callbacks {
 public:
  Callbacks(size_t rows, Functions functions) : rows(rows) {
    for (const mxArray* function : functions) {
      mxArray* copy = function ? mxDuplicateArray(function) : nullptr;
      if (copy) mexMakeArrayPersistent(copy);
      functions_.push_back(copy);
    }
  }
  ~Callbacks() {
    for (mxArray* function : functions_)
      if (function && !interpreter_ends) mxDestroyArray(function);
  }
  Callbacks(const Callbacks&) = delete;
  Callbacks& operator=(const Callbacks&) = delete;

  static void release(void* user) { delete static_cast<Callbacks*>(user); }

  // Runs one. The array that it returns is not null if the function threw: it is what was thrown.
  mxArray* run(size_t index, mxArray** outputs, int output_count, std::initializer_list<mxArray*> inputs) const {
    mxArray* arguments[1 + most] = {functions_[index]};
    std::copy(inputs.begin(), inputs.end(), arguments + 1);
    mxArray* results[1 + most] = {};
    mxArray* trouble = mexCallMATLABWithTrap(1 + output_count, results, 1 + static_cast<int>(inputs.size()), arguments,
                                             "cairn.internal.guarded");
    for (mxArray* input : inputs) mxDestroyArray(input);
    if (trouble) return trouble;
    std::copy(results + 1, results + 1 + output_count, outputs);
    if (!mxIsEmpty(results[0])) return results[0];
    mxDestroyArray(results[0]);
    return nullptr;
  }

  const size_t rows;  // of the custom sensor
  // A function may hold an object of this package. Destroying it would run code of an interpreter that is gone.
  static inline bool interpreter_ends = false;

 private:
  static constexpr int most = 3;  // inputs or outputs of a function
  std::vector<mxArray*> functions_;
};

namespace callbacks {

extern const Struct* const pose_type;  // in functions.hpp

// What it throws must not leave it: the library would be unwound.
template <typename Body>
int32_t answer(Body body) noexcept {
  if (!Call::current) return -1;  // a handle is being destroyed
  Call& call = *Call::current;
  try {
    mxArray* thrown = body();
    if (!thrown) return 1;
    call.callback_error = thrown;
    return -1;
  } catch (int not_visible) {
    return not_visible;
  } catch (...) {
    call.callback_exception = std::current_exception();
    return -1;
  }
}

inline void take(mxArray* value, const char* function, const char* name, double* to, size_t rows, size_t columns) {
  read_matrix(value, to, rows, columns, {function, name});
  mxDestroyArray(value);
}

inline int32_t cairn_custom_predict_fn(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                                       double* jacobian_pose, double* jacobian_landmark) {
  return answer([&]() -> mxArray* {
    const auto& functions = *static_cast<const Callbacks*>(user);
    mxArray* outputs[3];
    if (mxArray* thrown = functions.run(
            0, outputs, 3, {write_object(*pose_type, pose, sizeof *pose, 1), write_columns(landmark, 3, 1)}))
      return thrown;
    if (mxIsEmpty(outputs[0])) throw 0;
    take(outputs[0], "predict", "z", z, functions.rows, 1);
    take(outputs[1], "predict", "jacobian_pose", jacobian_pose, functions.rows, 6);
    take(outputs[2], "predict", "jacobian_landmark", jacobian_landmark, functions.rows, 3);
    return nullptr;
  });
}

inline int32_t cairn_custom_place_fn(void* user, const cairn_pose* pose, const double* z, double landmark[3],
                                     double jacobian_pose[18], double* jacobian_z) {
  return answer([&]() -> mxArray* {
    const auto& functions = *static_cast<const Callbacks*>(user);
    mxArray* outputs[3];
    if (mxArray* thrown = functions.run(
            1, outputs, 3, {write_object(*pose_type, pose, sizeof *pose, 1), write_columns(z, functions.rows, 1)}))
      return thrown;
    if (mxIsEmpty(outputs[0])) throw 0;
    take(outputs[0], "place", "landmark", landmark, 3, 1);
    take(outputs[1], "place", "jacobian_pose", jacobian_pose, 3, 6);
    take(outputs[2], "place", "jacobian_z", jacobian_z, 3, functions.rows);
    return nullptr;
  });
}

// A log has no way to abort the call: the call goes on, and a warning follows it.
inline void cairn_log_fn(void* payload, const char* line) {
  answer([&]() -> mxArray* {
    const auto& functions = *static_cast<const Callbacks*>(payload);
    if (mxArray* thrown = functions.run(0, nullptr, 0, {mxCreateString(line)})) {
      const mxArray* message = mxGetField(thrown, 0, "message");
      Call::current->log_error = message ? read_text(message, {"log", "message"}) : "an error without a message";
    }
    return nullptr;
  });
}

}  // namespace callbacks
}  // namespace cairn_octave
