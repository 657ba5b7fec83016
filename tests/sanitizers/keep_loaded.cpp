/// Keeps libraries loaded to the end of the program. Linked into tests under the address sanitizer: what a
/// library has lost is told with the names of its functions then, and what its own static data still holds is
/// no leak.

#include <dlfcn.h>

extern "C" __attribute__((visibility("default"))) int dlclose(void*) noexcept {
  return 0;
}
