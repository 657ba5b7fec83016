#pragma once
/// How the modules of modules.hpp make their functions visible.

#include "geometry/base/module_loader.hpp"
