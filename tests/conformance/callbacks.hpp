/* SPDX-License-Identifier: BSD-3-Clause */
/* The callbacks that scenarios name; README.md has their formulas. */
#ifndef CAIRN_TESTS_CONFORMANCE_CALLBACKS_HPP
#define CAIRN_TESTS_CONFORMANCE_CALLBACKS_HPP

#include <cairn/cairn.h>

#include <string>
#include <vector>

namespace conformance {

/* What a callback gets from the library as its own pointer. */
struct Payload {
  std::string predict, place;
  uint32_t rows = 3;
  std::vector<std::string>* lines = nullptr;
  int released = 0;
};

bool is_predict(const std::string& name);
bool is_place(const std::string& name);

}  // namespace conformance

/* Have the linkage that the library's types have. `user` is a Payload, which says which function is meant. */
extern "C" {
int32_t conformance_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                            double* jacobian_pose, double* jacobian_landmark);
int32_t conformance_place(void* user, const cairn_pose* pose, const double* z, double landmark[3],
                          double* jacobian_pose, double* jacobian_z);
void conformance_log(void* payload, const char* line);
void conformance_release(void* user);
}

#endif
