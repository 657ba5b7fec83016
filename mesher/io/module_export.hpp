#pragma once
/// How the modules of modules.hpp make their functions visible.

#include "geometry/module_loader.hpp"
