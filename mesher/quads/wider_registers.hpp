#pragma once
/// Functions marked so are compiled a second time for processors with registers of four numbers; the results
/// are the same to the last bit.

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define QUADRILLE_FOR_WIDER_REGISTERS __attribute__((target_clones("avx2", "default")))
#else
#define QUADRILLE_FOR_WIDER_REGISTERS
#endif
