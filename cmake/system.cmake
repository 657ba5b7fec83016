# Places of Debian that the build names, see docs/porting.md.

# OpenVDB's find module, which Debian keeps in a separate folder.
list(APPEND CMAKE_MODULE_PATH /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)

# The interpreter to build the Python module for and to run scripts with: FreeCAD embeds Debian's own; another python3 may
# come first on PATH.
set(DEFAULT_PYTHON /usr/bin/python3)
