/* SPDX-License-Identifier: BSD-3-Clause */
/* A library of another version: compiled with -DVERSION='"0.1.1"', and -DNUMBER=101 where that version has a number. */
const char *cairn_version(void);
const char *cairn_version(void) { return VERSION; }
#ifdef NUMBER
unsigned cairn_version_number(void);
unsigned cairn_version_number(void) { return NUMBER; }
#endif
