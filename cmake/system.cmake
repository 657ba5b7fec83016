# What the build asks of the operating system, one function a concern, each with one implementation now: docs/porting.md
# tells what others need.

# Where OpenVDB's find module lies: Debian keeps it apart.
function(quadrille_openvdb_module result)
  set(${result} /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB PARENT_SCOPE)
endfunction()

# The target that gives pictures a display, which the picture module links.
macro(quadrille_find_display result)
  find_package(X11 REQUIRED)
  set(${result} X11::X11)
endmacro()

# The interpreter to build the Python module for and to run scripts with: FreeCAD embeds Debian's own; another python3 may
# come first on PATH.
function(quadrille_default_python result)
  set(${result} /usr/bin/python3 PARENT_SCOPE)
endfunction()
