# The library as a part of another project, by add_subdirectory. Run by ctest, see CMakeLists.txt.
include(${CMAKE_CURRENT_LIST_DIR}/consume.cmake)

# The sources as a part of another project: the libraries and nothing else.
# Built is only what one component needs, as the installed libraries were built already; configured are all.
consume(add_subdirectory -D OCTUPOLE_SOURCE_DIR=${SOURCE_DIR} -D COMPONENTS=cost_functions)
run(${configure} -B ${WORK_DIR}/add_subdirectory_all -D OCTUPOLE_SOURCE_DIR=${SOURCE_DIR}
    -D CMAKE_DISABLE_FIND_PACKAGE_OpenMesh=ON)
if(WITH_OPENMESH)
  run(${configure} -B ${WORK_DIR}/add_subdirectory_openmesh -D OCTUPOLE_SOURCE_DIR=${SOURCE_DIR}
      -D OCTUPOLE_WITH_OPENMESH=ON -D COMPONENTS=openmesh)
endif()
foreach(folder tools tests examples benchmarks)
  if(EXISTS ${WORK_DIR}/add_subdirectory/octupole/${folder})
    message(FATAL_ERROR "add_subdirectory builds ${folder} too")
  endif()
endforeach()
