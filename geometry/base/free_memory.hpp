#pragma once
/// How much memory this process may still take.

namespace quadrille {

/// Bytes: the least of the memory available on the machine, what the control group's limit leaves, and what
/// the limit on the address space (ulimit -v) leaves. Infinite where none of these is known.
double free_memory();

}  // namespace quadrille
