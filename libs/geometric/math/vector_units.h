#pragma once

/// Attribute of a function: the compiler makes a version of it for each kind of vector unit, and
/// the program selects the widest of the machine at its start. All are bitwise equal: none reorders
/// or fuses operations.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HANDWAY_VECTOR_UNITS \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define HANDWAY_VECTOR_UNITS
#endif

/// Pragma before a loop over a few lanes that puts one bit of each together: the compiler would
/// unroll it first, and not vectorize it then.
#if defined(__GNUC__) && !defined(__clang__)
#define HANDWAY_LANES _Pragma("GCC unroll 1")
#else
#define HANDWAY_LANES
#endif
