# Uses the library as others would: from an installed package and with add_subdirectory. Run by ctest, see CMakeLists.txt.
# What it builds stays in WORK_DIR, so that the next run only builds what has changed.

# run(<command> ...) fails with the command's output; run(FAILS <regex> <command> ...) wants it to fail with that message.
function(run)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "FAILS" "")
  execute_process(COMMAND ${arg_UNPARSED_ARGUMENTS} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  list(JOIN arg_UNPARSED_ARGUMENTS " " command)
  if(NOT arg_FAILS AND NOT result EQUAL 0)
    message("${output}")
    message(FATAL_ERROR "failed with ${result}: ${command}")
  endif()
  string(REGEX REPLACE "[ \n]+" " " output_on_one_line "${output}")  # CMake wraps its messages
  if(arg_FAILS AND (result EQUAL 0 OR NOT output_on_one_line MATCHES "${arg_FAILS}"))
    message("${output}")
    message(FATAL_ERROR "should have failed with \"${arg_FAILS}\": ${command}")
  endif()
endfunction()

set(configure ${CMAKE_COMMAND} -G ${GENERATOR} -S ${CMAKE_CURRENT_LIST_DIR}/consumer
    -D VERSION=${VERSION} -D CMAKE_CXX_COMPILER=${CXX_COMPILER} -D CMAKE_CXX_FLAGS= -D CMAKE_CXX_STANDARD=14 -D CMAKE_EXPORT_COMPILE_COMMANDS=ON)

# consume(<name> <arguments for the consumer's configuration> ...): configures, builds and runs it, and looks at how its
# own sources were compiled: of ours, nothing but include folders and C++17 (in place of the 14 asked for) reaches them.
function(consume name)
  run(${configure} -B ${WORK_DIR}/${name} ${ARGN})
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/${name} --parallel 2)
  run(${CMAKE_CTEST_COMMAND} --test-dir ${WORK_DIR}/${name} --output-on-failure --no-tests=error)
  file(STRINGS ${WORK_DIR}/${name}/compile_commands.json commands REGEX "\"command\": .*packaging/consumer")
  if(NOT commands OR commands MATCHES " -([WOfmg]|std=[^ ]*14)[^ ]*")
    message(FATAL_ERROR "${name}: wrong flag \"${CMAKE_MATCH_0}\" in the consumer's compilation: ${commands}")
  endif()
endfunction()

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
