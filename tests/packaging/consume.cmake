# What the packaging tests share. What they build stays in WORK_DIR, so that the next run only builds what has changed.

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
