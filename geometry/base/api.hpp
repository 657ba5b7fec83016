#pragma once
/// What programs that link libquadrille.so can call.

/// Before a class or function of the public headers: all else stays inside the library.
#define QUADRILLE_API __attribute__((visibility("default")))
