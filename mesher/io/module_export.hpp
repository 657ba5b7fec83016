#pragma once
/// For the modules of modules.hpp, which export their functions with QUADRILLE_EXPORT.

#include "geometry/base/module_loader.hpp"
