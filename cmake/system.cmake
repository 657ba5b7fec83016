# What the build asks of the operating system, one function a concern, each with one implementation a system: docs/porting.md
# tells what others need.

# Where OpenVDB's find module lies: Debian keeps it apart. On Windows it lies among what scripts/windows.sh has built.
function(quadrille_openvdb_module result)
  if(WIN32)
    set(${result} ${CMAKE_PREFIX_PATH}/lib/cmake/OpenVDB PARENT_SCOPE)
  else()
    set(${result} /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB PARENT_SCOPE)
  endif()
endfunction()

# CGAL's headers. On Windows without GMP and MPFR: Boost's numbers are exact too.
macro(quadrille_find_cgal)
  if(WIN32)
    find_path(CGAL_INCLUDE_DIR CGAL/version.h REQUIRED)
    add_library(CGAL::CGAL INTERFACE IMPORTED)
    target_include_directories(CGAL::CGAL SYSTEM INTERFACE ${CGAL_INCLUDE_DIR})
    target_compile_definitions(CGAL::CGAL INTERFACE CGAL_DISABLE_GMP CGAL_HEADER_ONLY)
    target_compile_options(CGAL::CGAL INTERFACE -frounding-math)
  else()
    find_package(CGAL REQUIRED)
  endif()
endmacro()

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

# Libraries that our code for this system calls.
set(SYSTEM_LIBRARIES ${CMAKE_DL_LIBS})
if(WIN32)
  set(SYSTEM_LIBRARIES psapi shell32)
  # Modules are called as libraries are on other systems.
  set(CMAKE_SHARED_MODULE_PREFIX "")
  # The same functions as elsewhere: file names of 32 767 letters, no macros min and max.
  add_compile_definitions(UNICODE _UNICODE NOMINMAX WIN32_LEAN_AND_MEAN _WIN32_WINNT=0x0A00 _USE_MATH_DEFINES)
endif()
