include(CMakePackageConfigHelpers)

# octupole_add_library(<component> [ROOMS ...] [HEADERS ...] [SOURCES ...] [LINK ...] [LINK_PRIVATE ...] [PRECOMPILE ...])
#
# Makes the target octupole_<component> with the alias octupole::<component>, the current folder as its include root,
# and an export set of its own, so that a consumer of one component needs the dependencies of that one only.
# Of each room, a folder octupole/<room>, all headers are public and installed but those in its folder internal/.
function(octupole_add_library component)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ROOMS;HEADERS;SOURCES;LINK;LINK_PRIVATE;PRECOMPILE")
  foreach(room IN LISTS arg_ROOMS)
    file(GLOB headers CONFIGURE_DEPENDS octupole/${room}/*.h)
    file(GLOB sources CONFIGURE_DEPENDS octupole/${room}/*.cc octupole/${room}/internal/*)
    list(APPEND arg_HEADERS ${headers})
    list(APPEND arg_SOURCES ${sources})
  endforeach()
  set(target octupole_${component})
  if(arg_SOURCES)
    set(scope PUBLIC)
    add_library(${target})
    target_sources(${target} PRIVATE ${arg_SOURCES})
  else()
    set(scope INTERFACE)
    add_library(${target} INTERFACE)
  endif()
  add_library(octupole::${component} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${component} POSITION_INDEPENDENT_CODE ON
                        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(${target} ${scope} cxx_std_17)
  # A header that has a source is what that includes first, and so compiled with it; only the others need be verified.
  set(alone ${arg_HEADERS})
  list(TRANSFORM arg_SOURCES REPLACE "\\.cc$" ".h" OUTPUT_VARIABLE with_source)
  list(REMOVE_ITEM alone ${with_source})
  list(REMOVE_ITEM arg_HEADERS ${alone})
  target_sources(${target} ${scope}
                 FILE_SET HEADERS BASE_DIRS ${CMAKE_CURRENT_SOURCE_DIR} FILES ${arg_HEADERS}
                 FILE_SET alone TYPE HEADERS BASE_DIRS ${CMAKE_CURRENT_SOURCE_DIR} FILES ${alone})
  set_target_properties(${target} PROPERTIES INTERFACE_HEADER_SETS_TO_VERIFY alone)
  target_link_libraries(${target} ${scope} ${arg_LINK})
  if(arg_PRECOMPILE AND PROJECT_IS_TOP_LEVEL)  # the packaging test builds without, so that no include goes missing
    target_precompile_headers(${target} PRIVATE ${arg_PRECOMPILE})
  endif()
  if(arg_LINK_PRIVATE)
    target_link_libraries(${target} PRIVATE ${arg_LINK_PRIVATE})
  endif()
  install(TARGETS ${target} EXPORT octupole-${component}
          LIBRARY COMPONENT libraries NAMELINK_COMPONENT development
          ARCHIVE COMPONENT development
          FILE_SET HEADERS COMPONENT development
          FILE_SET alone COMPONENT development)
  install(EXPORT octupole-${component} NAMESPACE octupole:: COMPONENT development
          FILE octupole-${component}-targets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/octupole)
  if(NOT BUILD_SHARED_LIBS)  # a static library leaves it to its users to link what it uses inside
    list(APPEND arg_LINK ${arg_LINK_PRIVATE})
  endif()
  octupole_install_pkg_config(${component} "${arg_LINK}" "${arg_SOURCES}")
endfunction()

# octupole_install_pkg_config(<component> <linked targets> <sources>): octupole-<component>.pc, wherever the prefix is.
function(octupole_install_pkg_config component targets sources)
  set(packages)
  set(libraries)
  if(sources)
    set(libraries -loctupole_${component})
  endif()
  foreach(target IN LISTS targets)
    if(target MATCHES "^octupole::(.*)")
      list(APPEND packages octupole-${CMAKE_MATCH_1})
    elseif(target STREQUAL Eigen3::Eigen)
      list(APPEND packages eigen3)
    elseif(target STREQUAL Ceres::ceres)  # has no file of its own
      list(APPEND packages libglog)
      list(APPEND libraries -lceres)
    elseif(target STREQUAL OpenMeshCore)
      list(APPEND packages openmesh)
    elseif(target STREQUAL pugixml::pugixml)
      list(APPEND packages pugixml)
    elseif(target STREQUAL ZLIB::ZLIB)
      list(APPEND packages zlib)
    elseif(target STREQUAL Gmsh::Gmsh)
      list(APPEND libraries -lgmsh)
    elseif(target STREQUAL OpenVDB::openvdb)
      list(APPEND libraries -lopenvdb)
    elseif(target STREQUAL PETSc::petsc)
      list(APPEND packages PETSc mpi-c)
    else()
      message(FATAL_ERROR "octupole_install_pkg_config: ${target}: say here what pkg-config calls it")
    endif()
  endforeach()
  list(JOIN packages " " packages)
  list(JOIN libraries " " libraries)
  set(destination ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  file(RELATIVE_PATH to_prefix /${destination} /)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/octupole.pc.in ${CMAKE_CURRENT_BINARY_DIR}/octupole-${component}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octupole-${component}.pc DESTINATION ${destination} COMPONENT development)
endfunction()

# Debian has Ceres in both kinds, and tells CMake of the static one only. Each of our shared libraries would hold a copy.
function(octupole_prefer_shared_ceres)
  get_target_property(location Ceres::ceres IMPORTED_LOCATION_RELEASE)
  string(REGEX REPLACE "\\.a$" ".so" shared "${location}")
  if(BUILD_SHARED_LIBS AND EXISTS "${shared}")
    set_target_properties(Ceres::ceres PROPERTIES IMPORTED_LOCATION_RELEASE "${shared}")
  endif()
endfunction()

# Installs the package configuration behind find_package(octupole).
function(octupole_install_package)
  set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/octupole)
  configure_package_config_file(cmake/octupole-config.cmake.in octupole-config.cmake INSTALL_DESTINATION ${destination})
  write_basic_package_version_file(octupole-config-version.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octupole-config.cmake
                ${CMAKE_CURRENT_BINARY_DIR}/octupole-config-version.cmake DESTINATION ${destination}
          COMPONENT development)
  if(OCTUPOLE_WITH_GMSH)
    install(FILES cmake/FindGmsh.cmake DESTINATION ${destination} COMPONENT development)
  endif()
  if(OCTUPOLE_WITH_OPENVDB)
    install(FILES cmake/OctupoleFindOpenVDB.cmake DESTINATION ${destination})
  endif()
  if(OCTUPOLE_WITH_PETSC)
    install(FILES cmake/OctupoleFindPetsc.cmake DESTINATION ${destination} COMPONENT development)
  endif()
endfunction()
