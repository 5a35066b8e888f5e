/* SPDX-License-Identifier: BSD-3-Clause */
/* Stands for libraries that the package must refuse. NUMBER: the version as a number, if that version has one. */
#include <stdint.h>

const char *cairn_version(void) { return VERSION; }

#ifdef NUMBER
uint32_t cairn_version_number(void) { return NUMBER; }
#endif
