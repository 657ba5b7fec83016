# Debian packages by CPack, one per component; scripts/package.sh makes them. Included by install.cmake.

# Man pages and shell completion, generated from the command's help.
set(MANUAL ${PROJECT_BINARY_DIR}/manual)
add_custom_command(OUTPUT ${MANUAL}/stamp
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${MANUAL}
  COMMAND ${Python_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/make_manual.py $<TARGET_FILE:quadrille> ${MANUAL}
  COMMAND ${CMAKE_COMMAND} -E touch ${MANUAL}/stamp
  DEPENDS quadrille ${PROJECT_SOURCE_DIR}/scripts/make_manual.py VERBATIM)
add_custom_target(manual ALL DEPENDS ${MANUAL}/stamp)
install(DIRECTORY ${MANUAL}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command FILES_MATCHING PATTERN "*.1.gz")
install(FILES ${MANUAL}/quadrille.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME quadrille
  COMPONENT command)

set(PACKAGE_command quadrille)
set(PACKAGE_library libquadrille${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(PACKAGE_development libquadrille-dev)
set(PACKAGE_python python3-quadrille)
set(PACKAGE_addon freecad-quadrille)
set(COMPONENTS command library development python addon)

# The release of Debian is part of the version: each has libraries of its own.
file(STRINGS /etc/os-release os_release REGEX "^VERSION_ID=")
string(REGEX REPLACE "[^0-9]" "" QUADRILLE_DEBIAN "${os_release}")
set(QUADRILLE_RELEASE 1~deb${QUADRILLE_DEBIAN})
# The maintainer is given as for Debian's own tools, by DEBFULLNAME and DEBEMAIL. Without them there is no address, which
# lintian reports.
set(maintainer "The Quadrille maintainers")
set(address quadrille@localhost.localdomain)
if(DEFINED ENV{DEBFULLNAME})
  set(maintainer $ENV{DEBFULLNAME})
endif()
if(DEFINED ENV{DEBEMAIL})
  set(address $ENV{DEBEMAIL})
endif()
set(QUADRILLE_MAINTAINER "${maintainer} <${address}>")
set(DATE_FORMAT "%a, %d %b %Y %H:%M:%S +0000")
string(TIMESTAMP QUADRILLE_DATE "${DATE_FORMAT}" UTC)  # SOURCE_DATE_EPOCH, where it is set
foreach(component ${COMPONENTS})
  set(QUADRILLE_PACKAGE ${PACKAGE_${component}})
  set(folder ${PROJECT_BINARY_DIR}/documents/${QUADRILLE_PACKAGE})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/debian/changelog.in ${folder}/changelog.Debian @ONLY)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/debian/copyright ${folder}/copyright COPYONLY)
  execute_process(COMMAND gzip -9nf ${folder}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${folder}/copyright ${folder}/changelog.Debian.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${QUADRILLE_PACKAGE} COMPONENT ${component})
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${QUADRILLE_PACKAGE})
  set(CPACK_DEBIAN_${COMPONENT}_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_SECTION science)
endforeach()
set(same "(= ${PROJECT_VERSION}-${QUADRILLE_RELEASE})")
set(CPACK_COMPONENTS_ALL ${COMPONENTS})
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_NAME quadrille)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "${QUADRILLE_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
  WORLD_EXECUTE)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${QUADRILLE_RELEASE})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS "${PACKAGE_library} ${same}")
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS xvfb)  # a display for pictures, where there is none
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "${PACKAGE_library} ${same}, libeigen3-dev, libfmt-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
math(EXPR next_python "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${PACKAGE_library} ${same}, ${PACKAGE_command} ${same}, python3-numpy, \
python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python})")
set(CPACK_DEBIAN_ADDON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_ADDON_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_ADDON_PACKAGE_DEPENDS "${PACKAGE_command} ${same}, freecad")
file(WRITE ${PROJECT_BINARY_DIR}/documents/triggers "activate-noawait ldconfig\n")
file(WRITE ${PROJECT_BINARY_DIR}/documents/shlibs
  "libquadrille ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} ${PACKAGE_library} ${same}\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/documents/triggers
  ${PROJECT_BINARY_DIR}/documents/shlibs)
foreach(pair "PYTHON;python3-quadrille" "ADDON;freecad-quadrille")
  list(POP_FRONT pair component PACKAGE)
  set(prerm ${PROJECT_BINARY_DIR}/documents/${PACKAGE}/prerm)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/debian/prerm.in ${prerm} @ONLY FILE_PERMISSIONS OWNER_READ OWNER_WRITE
    OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  set(CPACK_DEBIAN_${component}_PACKAGE_CONTROL_EXTRA ${prerm})
endforeach()
set(about "Quadrille meshes the faces of CAD parts with quads only, for finite elements:\n\
one chain of nodes on each edge, nodes on the geometry, groups named as in\n\
FreeCAD.\n")
foreach(pair "COMMAND;all-quad shell meshes of CAD parts;This package has the command."
    "LIBRARY;all-quad shell meshes of CAD parts - library;This package has the shared library and its modules."
    "DEVELOPMENT;all-quad shell meshes of CAD parts - headers;This package has the headers for C++ programs."
    "PYTHON;all-quad shell meshes of CAD parts - Python module;This package has the Python module."
    "ADDON;all-quad shell meshes of CAD parts - FreeCAD addon;This package has the workbench of FreeCAD.")
  list(POP_FRONT pair component summary text)
  set(CPACK_DEBIAN_${component}_DESCRIPTION "${summary}\n${about}${text}")
endforeach()
include(CPack)
