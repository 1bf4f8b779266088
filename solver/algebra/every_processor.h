#pragma once

/// Marks a function that is compiled for several processors; the present one is found when the program
/// starts. Functions that it calls must be NURBEAM_WITHIN it. The source is compiled without fused products
/// and sums: registers of any width give the same bits.
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define NURBEAM_FOR_EVERY_PROCESSOR [[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#else
#define NURBEAM_FOR_EVERY_PROCESSOR
#endif
#define NURBEAM_WITHIN [[gnu::always_inline]] inline
