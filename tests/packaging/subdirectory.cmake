# The library as a part of another project, by add_subdirectory. Run by ctest, see CMakeLists.txt.
include(${CMAKE_CURRENT_LIST_DIR}/consume.cmake)

# The sources as a part of another project: the libraries and nothing else. Each source is compiled alone here.
# Built is what two components need; configured are all.
set(components solvers)
if(WITH_OPENMESH)
  string(APPEND components ",openmesh")
endif()
consume(add_subdirectory -D OCTUPOLE_SOURCE_DIR=${SOURCE_DIR} -D OCTUPOLE_WITH_OPENMESH=${WITH_OPENMESH}
        -D COMPONENTS=${components})
run(${configure} -B ${WORK_DIR}/add_subdirectory_all -D OCTUPOLE_SOURCE_DIR=${SOURCE_DIR}
    -D CMAKE_DISABLE_FIND_PACKAGE_OpenMesh=ON)
foreach(folder tools tests examples benchmarks)
  if(EXISTS ${WORK_DIR}/add_subdirectory/octupole/${folder})
    message(FATAL_ERROR "add_subdirectory builds ${folder} too")
  endif()
endforeach()
