#pragma once
/// How much memory this process may still take.

namespace quadrille {

/// Bytes: the least of what the machine has available, what the control group's limit leaves and what
/// the limit on the address space (ulimit -v) leaves; infinite where nothing tells.
double free_memory();

}  // namespace quadrille
