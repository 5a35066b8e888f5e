// SPDX-License-Identifier: BSD-3-Clause
// The functions of the library for Octave and MATLAB: cairn_mex(NAME, ARGUMENT...) calls cairn_NAME. The package +cairn
// is what users call.
#include "callbacks.hpp"
#include "functions.hpp"  // generated

namespace cairn_octave {
namespace {

constexpr uint32_t minor_version(uint32_t number) {
  return number / 100;
}

// Once. A library of another minor version may have other structs.
void load() {
  static bool loaded = false;
  if (loaded) return;
  if (minor_version(cairn_version_number()) != minor_version(CAIRN_VERSION))
    fail("LIBRARY", "Cairn for Octave is version %d.%d.%d, but the library libcairn that was loaded is version %s",
         CAIRN_VERSION_MAJOR, CAIRN_VERSION_MINOR, CAIRN_VERSION_PATCH, cairn_version());
  mexLock();  // "clear all" must not unload what handles stand in
  mexAtExit([] {
    Callbacks::interpreter_ends = true;
    handles.close_all();
  });
  loaded = true;
}

uint64_t number_of(int inputs, const mxArray* const* arguments) {
  if (inputs != 1 || mxGetClassID(arguments[0]) != mxUINT64_CLASS || mxGetNumberOfElements(arguments[0]) != 1) return 0;
  return *static_cast<const uint64_t*>(mxGetData(arguments[0]));
}

void run(int outputs, mxArray** results, int inputs, const mxArray* const* arguments) {
  char name[64];
  if (inputs < 1 || mxGetString(arguments[0], name, sizeof name) != 0)
    fail("ARGUMENT", "cairn_mex: the first argument must be the name of a function");
  load();
  --inputs;
  ++arguments;
  if (std::strcmp(name, "load") == 0) return;
  if (std::strcmp(name, "close") == 0) return handles.close(number_of(inputs, arguments));
  if (std::strcmp(name, "is_open") == 0) {
    results[0] = mxCreateLogicalScalar(handles.open(number_of(inputs, arguments)));
    return;
  }
  const auto found = functions.find(name);
  if (found == functions.end()) fail("ARGUMENT", "cairn_mex: there is no function cairn_%s", name);
  Call call(found->second.short_name, outputs, results, inputs, arguments);
  if (inputs > found->second.inputs || outputs > found->second.outputs)
    fail("ARGUMENT", "%s: at most %d arguments and %d results", found->second.short_name, found->second.inputs,
         found->second.outputs);
  found->second.run(call);
}

}  // namespace
}  // namespace cairn_octave

// An error of Octave may leave this function without destructors: all of C++ is over before it.
void mexFunction(int nlhs, mxArray* plhs[], int nrhs, const mxArray* prhs[]) {
  static char id[64], text[1024];
  mxArray* thrown = nullptr;
  try {
    cairn_octave::run(nlhs, plhs, nrhs, prhs);
    return;
  } catch (const cairn_octave::Failure& failure) {
    std::snprintf(id, sizeof id, "%s", failure.id.c_str());
    std::snprintf(text, sizeof text, "%s", failure.text.c_str());
  } catch (mxArray* error) {
    thrown = error;
  } catch (const std::bad_alloc&) {
    std::snprintf(id, sizeof id, "cairn:MEMORY");
    std::snprintf(text, sizeof text, "there is not enough memory");
  }
  if (thrown) mexCallMATLAB(0, nullptr, 1, &thrown, "rethrow");
  // mexErrMsgIdAndTxt of Octave would put "cairn_mex: " before the message of the library.
  mxArray* arguments[3] = {mxCreateString(id), mxCreateString("%s"), mxCreateString(text)};
  mexCallMATLAB(0, nullptr, 3, arguments, "error");
}
