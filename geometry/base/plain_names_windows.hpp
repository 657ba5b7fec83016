#pragma once
/// Included before all else in a build for Windows: its header, which OpenCASCADE and oneTBB include, makes
/// macros of words that programs use.

#include <windows.h>

#undef near
#undef far
#undef small
#undef interface
