#pragma once
/// What programs that link the shared library can call.

/// Marks a class or function of the public headers. Everything else stays inside the library.
#ifdef _WIN32
#define QUADRILLE_API __declspec(dllexport)
#else
#define QUADRILLE_API __attribute__((visibility("default")))
#endif
