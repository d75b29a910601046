# The library as an installed package. Run by ctest, see CMakeLists.txt.
include(${CMAKE_CURRENT_LIST_DIR}/consume.cmake)

# The package, moved to another place after its installation.
file(REMOVE_RECURSE ${WORK_DIR}/staged ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/staged)
file(RENAME ${WORK_DIR}/staged ${WORK_DIR}/prefix)
file(GLOB_RECURSE package_files ${WORK_DIR}/prefix/*.cmake)
foreach(package_file IN LISTS package_files)
  file(READ ${package_file} content)
  # Paths begin after a quote or a semicolon: the sources may lie in a folder whose name is part of the package's own paths.
  string(REPLACE ";" "\"" content "${content}")
  foreach(unwanted INTERFACE_COMPILE_OPTIONS INTERFACE_LINK_OPTIONS "\"${SOURCE_DIR}/" ${WORK_DIR}/staged)
    string(FIND "${content}" "${unwanted}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${package_file} mentions ${unwanted}")
    endif()
  endforeach()
endforeach()
consume(find_package -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix -D CMAKE_DISABLE_FIND_PACKAGE_OpenMesh=ON)
foreach(component core cost_functions solvers)
  run(${configure} -B ${WORK_DIR}/only_${component} -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix -D COMPONENTS=${component})
endforeach()
consume(core_without_ceres -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix -D COMPONENTS=core
        -D CMAKE_DISABLE_FIND_PACKAGE_Ceres=ON)
if(WITH_OPENMESH)
  consume(openmesh_without_ceres -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix -D COMPONENTS=openmesh
          -D CMAKE_DISABLE_FIND_PACKAGE_Ceres=ON)
endif()
run(FAILS "octupole has no component \"surfaces\"" ${configure} -B ${WORK_DIR}/unknown_component
    -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix "-D COMPONENTS=core;surfaces")
