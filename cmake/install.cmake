# Where `cmake --install` puts files. Each component is a separate package; see docs/install.md.
include(CMakePackageConfigHelpers)

# The command is in the folder of its modules, where it searches them; in bin there is a link to it.
install(TARGETS quadrille RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR}/quadrille COMPONENT command)
file(RELATIVE_PATH command ${CMAKE_INSTALL_FULL_BINDIR} ${MODULES_FOLDER}/quadrille)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/link)
file(CREATE_LINK ${command} ${PROJECT_BINARY_DIR}/link/quadrille SYMBOLIC)
install(FILES ${PROJECT_BINARY_DIR}/link/quadrille DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
install(TARGETS ${MODULES} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/quadrille COMPONENT library)

install(DIRECTORY ${PUBLIC_INCLUDES}/quadrille DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(TARGETS quadrille_library EXPORT quadrille-targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
set(CONFIG_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/quadrille)
install(EXPORT quadrille-targets NAMESPACE quadrille:: DESTINATION ${CONFIG_FOLDER} COMPONENT development)
configure_package_config_file(cmake/quadrille-config.cmake.in ${PROJECT_BINARY_DIR}/quadrille-config.cmake
  INSTALL_DESTINATION ${CONFIG_FOLDER})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/quadrille-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/quadrille-config.cmake ${PROJECT_BINARY_DIR}/quadrille-config-version.cmake
  DESTINATION ${CONFIG_FOLDER} COMPONENT development)

if(QUADRILLE_PYTHON)
  # Where Debian's interpreter searches: for packages, for the administrator, otherwise in a user's own prefix.
  set(python lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(python_folder lib/python3/dist-packages)
  elseif(CMAKE_INSTALL_PREFIX STREQUAL "/usr/local")
    set(python_folder ${python}/dist-packages)
  else()
    set(python_folder ${python}/site-packages)
  endif()
  set(QUADRILLE_PYTHON_FOLDER ${python_folder} CACHE STRING "Where the Python package is installed, under the prefix")
  install(DIRECTORY workbench/quadrille DESTINATION ${QUADRILLE_PYTHON_FOLDER} COMPONENT python
    PATTERN "__pycache__" EXCLUDE)
  install(TARGETS quadrille_python LIBRARY DESTINATION ${QUADRILLE_PYTHON_FOLDER}/quadrille COMPONENT python)
endif()

# The FreeCAD addon: Debian's FreeCAD looks here; others need a copy, see install-addon.sh.
install(DIRECTORY workbench/ DESTINATION ${CMAKE_INSTALL_DATADIR}/freecad/Mod/Quadrille COMPONENT addon
  PATTERN "*.cpp" EXCLUDE PATTERN "*.hpp" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/freecad/Mod/Quadrille COMPONENT addon)

if(QUADRILLE_PACKAGES)
  include(cmake/packages.cmake)
endif()
