# Included at the end of each toolkit of OpenCASCADE by scripts/windows.sh: compiles the sources of a package together, twelve at
# a time, which takes a third of the time. Some are compiled separately: they define the same names as others, or macros that
# replace generics.
cmake_policy(SET CMP0057 NEW)  # if(IN_LIST)

set(SOURCES_APART
  AppDef_1 Approx_0 BOPAlgo_0 BRepApprox_1 BRepCheck_0 BRepFill_0 BRepFill_1 BRepFill_2 BRepLProp_0 BRepPrimAPI_0
  BRepSweep_0 BSplCLib_0 BinTools_0 Bisector_0 Bnd_0 Convert_0 Convert_1 Extrema_0 Extrema_2 Extrema_4 GCPnts_0
  Geom2dGcc_0 Geom2dInt_0 Geom2dLProp_0 Geom2d_0 GeomAdaptor_0 GeomFill_0 GeomFill_1 GeomFill_2 GeomInt_0 GeomInt_1
  GeomLProp_0 GeomTools_0 Geom_0 IFSelect_5 IGESSelect_1 IGESToBRep_0 IntPatch_0 LProp3d_0 Plate_0 ProjLib_0 RWStepGeom_0
  RWStepGeom_1 RWStepGeom_4 RWStepGeom_5 RWStepGeom_6 StepData_1 StepElement_0 StepElement_1 StepFile_0 StepSelect_0
  StepVisual_4 TopOpeBRepBuild_0 TopOpeBRepTool_2 TopOpeBRep_3 Transfer_1 math_0
)

function(join_packages toolkit)
  if(toolkit STREQUAL TKernel)
    return()
  endif()
  get_target_property(sources ${toolkit} SOURCES)
  list(FILTER sources INCLUDE REGEX "[.]cxx$")
  set(last "")
  foreach(source ${sources})
    string(REGEX REPLACE ".*/([A-Za-z0-9]+)/[^/]*$" "\\1" package ${source})
    if(NOT package STREQUAL last)
      set(count 0)
      set(last ${package})
    endif()
    math(EXPR group "${count} / 12")
    math(EXPR count "${count} + 1")
    if(NOT ${package}_${group} IN_LIST SOURCES_APART)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${package}_${group})
    endif()
  endforeach()
  set_target_properties(${toolkit} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
