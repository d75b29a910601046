# octupole_find_openvdb(): the target OpenVDB::openvdb. The find module lies in OpenVDB's own package, beside others that
# are not meant for us, and sets BUILD_SHARED_LIBS for whoever includes it: hence the function.
function(octupole_find_openvdb)
  find_path(OpenVDB_MODULE_DIR FindOpenVDB.cmake
            PATHS / /usr /usr/local PATH_SUFFIXES lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB lib/cmake/OpenVDB REQUIRED)
  list(PREPEND CMAKE_MODULE_PATH ${OpenVDB_MODULE_DIR})
  find_package(OpenVDB 10 REQUIRED)
endfunction()
