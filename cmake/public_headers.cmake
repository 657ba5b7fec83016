# The headers of the library: what mesher/quadrille.hpp and mesher/settings.hpp include, and nothing else.
set(PUBLIC_HEADERS
  geometry/base/api.hpp geometry/base/error.hpp geometry/base/execution_context.hpp geometry/base/number_rule.hpp
  geometry/base/vector.hpp geometry/cad/cad_model.hpp geometry/cad/ids.hpp geometry/midsurface/midsurface.hpp
  geometry/sizing/element_count.hpp geometry/sizing/sizing_field.hpp geometry/sizing/sizing_options.hpp
  mesher/estimate.hpp mesher/io/io.hpp mesher/io/limits_reader.hpp mesher/io/midsurface_writer.hpp
  mesher/mesh/criteria.hpp mesher/mesh/inp_element.hpp mesher/mesh/mesh_types.hpp mesher/mesh/quality.hpp mesher/options.hpp
  mesher/pairing/recombine.hpp mesher/pairing/recombine_options.hpp mesher/quadrille.hpp
  mesher/quads/improve_options.hpp mesher/remesh/remesh.hpp mesher/settings.hpp mesher/shell/from_triangles.hpp
  mesher/shell/validate.hpp mesher/size_map.hpp)

# Programs include them as quadrille/X.hpp (files of mesher/ itself) and quadrille/geometry/... or quadrille/mesher/..., so that
# no include folder has a geometry/ or mesher/ of ours. Copies whose own includes say so are made here.
set(PUBLIC_INCLUDES ${PROJECT_BINARY_DIR}/include)
file(GLOB_RECURSE outdated ${PUBLIC_INCLUDES}/quadrille/*.hpp)
foreach(header ${PUBLIC_HEADERS})
  file(READ ${PROJECT_SOURCE_DIR}/${header} text)
  string(REGEX REPLACE "#include \"(geometry|mesher)/" "#include \"quadrille/\\1/" text "${text}")
  string(REGEX REPLACE "#include \"quadrille/mesher/([a-z_]+[.]hpp)" "#include \"quadrille/\\1" text "${text}")
  string(REGEX REPLACE "^mesher/([a-z_]+[.]hpp)$" "\\1" public ${header})
  file(CONFIGURE OUTPUT ${PUBLIC_INCLUDES}/quadrille/${public} CONTENT "${text}" @ONLY)
  list(REMOVE_ITEM outdated ${PUBLIC_INCLUDES}/quadrille/${public})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${header})
endforeach()
if(outdated)
  file(REMOVE ${outdated})
endif()
