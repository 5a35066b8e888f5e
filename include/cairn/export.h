/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Symbol visibility and the version of the header. */
#ifndef CAIRN_EXPORT_H
#define CAIRN_EXPORT_H

/** Major version of this header. \ref cairn_version returns the version of the loaded library. */
#define CAIRN_VERSION_MAJOR 0
#define CAIRN_VERSION_MINOR 2 /**< minor version of this header */
#define CAIRN_VERSION_PATCH 0 /**< patch version of this header */

/** Version of this header as one number, for comparisons: 10000 major + 100 minor + patch. */
#define CAIRN_VERSION (10000 * CAIRN_VERSION_MAJOR + 100 * CAIRN_VERSION_MINOR + CAIRN_VERSION_PATCH)

/** \def CAIRN_API
 *  Marks a function of the C ABI. A caller that links the static library for Windows defines CAIRN_STATIC. Only the
 *  build of the library defines CAIRN_BUILDING. */
#if defined(CAIRN_STATIC)
#define CAIRN_API
#elif defined(_WIN32) && defined(CAIRN_BUILDING)
#define CAIRN_API __declspec(dllexport)
#elif defined(_WIN32)
#define CAIRN_API __declspec(dllimport)
#elif defined(__GNUC__)
#define CAIRN_API __attribute__((visibility("default")))
#else
#define CAIRN_API
#endif

#endif
