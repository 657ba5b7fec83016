# What the build needs from the operating system: one function per concern, each with one implementation per system.
# docs/porting.md lists what other systems need.

# scripts/windows.sh builds for Windows on Debian.
set(WINDOWS_ON_DEBIAN FALSE)
if(WIN32 AND CMAKE_CROSSCOMPILING)
  set(WINDOWS_ON_DEBIAN TRUE)
endif()

# OpenVDB; Debian keeps its find module in a separate folder. Built for Windows it is a static library without Boost.
macro(quadrille_find_openvdb)
  if(WINDOWS_ON_DEBIAN)
    add_library(OpenVDB::openvdb INTERFACE IMPORTED)
    target_include_directories(OpenVDB::openvdb SYSTEM INTERFACE ${CMAKE_PREFIX_PATH}/include)
    target_compile_definitions(OpenVDB::openvdb INTERFACE OPENVDB_STATICLIB)
    foreach(library openvdb blosc lz4 zstd z)
      find_library(OPENVDB_${library} NAMES lib${library}.a REQUIRED)
      target_link_libraries(OpenVDB::openvdb INTERFACE ${OPENVDB_${library}})
    endforeach()
    target_link_libraries(OpenVDB::openvdb INTERFACE TBB::tbb)
  else()
    list(APPEND CMAKE_MODULE_PATH /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
    find_package(OpenVDB REQUIRED)
  endif()
endmacro()

# CGAL's headers. Built for Windows without GMP and MPFR: Boost's numbers are exact too.
macro(quadrille_find_cgal)
  if(WINDOWS_ON_DEBIAN)
    add_library(CGAL::CGAL INTERFACE IMPORTED)
    target_include_directories(CGAL::CGAL SYSTEM INTERFACE ${CMAKE_PREFIX_PATH}/include)
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
  # Modules have the same names as on other systems.
  set(CMAKE_SHARED_MODULE_PREFIX "")
  # File names in UTF-16, and no macros that replace common words.
  add_compile_definitions(UNICODE _UNICODE NOMINMAX WIN32_LEAN_AND_MEAN _USE_MATH_DEFINES)
  add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${PROJECT_SOURCE_DIR}/geometry/base/plain_names_windows.hpp>")
endif()
