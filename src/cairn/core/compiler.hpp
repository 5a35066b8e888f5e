// SPDX-License-Identifier: BSD-3-Clause
// What GCC and clang add to C++17, by names of the project. Another compiler gets the nearest that it has, or nothing.
#pragma once

// Argument `text` of a function is a format of printf, whose values begin with argument `first`; `this` is the first.
#if defined(__MINGW32__) && !defined(__clang__)
#define CAIRN_PRINTF(text, first) [[gnu::format(gnu_printf, text, first)]]  // plain printf is that of Windows here
#elif defined(__GNUC__)
#define CAIRN_PRINTF(text, first) [[gnu::format(printf, text, first)]]
#else
#define CAIRN_PRINTF(text, first)
#endif

#if defined(__GNUC__)
#define CAIRN_ALWAYS_INLINE [[gnu::always_inline]] inline
#define CAIRN_NEVER_INLINE [[gnu::noinline]]
#elif defined(_MSC_VER)
#define CAIRN_ALWAYS_INLINE __forceinline
#define CAIRN_NEVER_INLINE __declspec(noinline)
#else
#define CAIRN_ALWAYS_INLINE inline
#define CAIRN_NEVER_INLINE
#endif

// Before a loop over constants: all its turns are written out.
#if defined(__clang__)
#define CAIRN_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define CAIRN_UNROLL _Pragma("GCC unroll 4")
#else
#define CAIRN_UNROLL
#endif

// Asks for a line of the cache before it is needed.
#if defined(__GNUC__)
#define CAIRN_PREFETCH_READ(address) __builtin_prefetch(address)
#define CAIRN_PREFETCH_WRITE(address) __builtin_prefetch(address, 1)
#else
#define CAIRN_PREFETCH_READ(address) static_cast<void>(address)
#define CAIRN_PREFETCH_WRITE(address) static_cast<void>(address)
#endif

// GCC and clang compute with a vector as with a number. CAIRN_PLAIN_LANES makes them do without, so that tests can see
// what other compilers get.
#if defined(__GNUC__) && !defined(CAIRN_PLAIN_LANES)
#define CAIRN_VECTOR_TYPES
#endif
