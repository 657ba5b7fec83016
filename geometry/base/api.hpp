#pragma once
/// What programs that link the shared library can call.

/// Marks a class or function of the public headers. Everything else stays inside the library.
#define QUADRILLE_API __attribute__((visibility("default")))
