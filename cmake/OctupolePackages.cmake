# Debian packages by cpack, for the preset package: octupole, liboctupole<major.minor>, liboctupole-dev, python3-octupole.
# What they depend on is computed: of programs and libraries by dpkg-shlibdeps, of headers from the packages that the
# files which CMake found belong to.

# octupole_debian_package_of(<file> <variable>): the package that a file belongs to.
function(octupole_debian_package_of file variable)
  file(REAL_PATH "${file}" file)
  execute_process(COMMAND dpkg-query --search ${file} OUTPUT_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${file} belongs to no Debian package, which liboctupole-dev could depend on")
  endif()
  string(REGEX REPLACE ":.*" "" package "${output}")
  set(${variable} ${package} PARENT_SCOPE)
endfunction()

set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(packages octupole liboctupole${soversion} liboctupole-dev python3-octupole)
set(CPACK_COMPONENTS_ALL command libraries development python)
set(CPACK_COMPONENT_COMMAND_DEPENDS libraries)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS libraries)
set(CPACK_COMPONENT_PYTHON_DEPENDS libraries)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Octupole maintainers <maintainers@octupole.example>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
    ${PROJECT_BINARY_DIR}/lib ${PROJECT_BINARY_DIR}/cost_functions ${PROJECT_BINARY_DIR}/solvers)

# The first line of each description is the package's title.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(about "Octupole computes three unsigned orthogonal axes at every vertex of a
tetrahedral mesh, smooth inside and aligned with the boundary, as hexahedral
meshers need them, and cross fields on surfaces.

This package has")
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME octupole)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "frame fields on meshes, the command\n${about} the command octupole.")

set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME liboctupole${soversion})
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARIES_DESCRIPTION "frame fields on meshes, the libraries\n${about} the shared libraries.")

file(WRITE ${PROJECT_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/triggers)

octupole_debian_package_of(${Eigen3_DIR}/Eigen3Config.cmake eigen)
octupole_debian_package_of(${Ceres_DIR}/CeresConfig.cmake ceres)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liboctupole-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${eigen} (>= 3.4), ${ceres} (>= 2.1)")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
    "frame fields on meshes, for C++ programs\n${about} the headers, and what CMake and pkg-config read.")
if(OCTUPOLE_WITH_OPENMESH)
  octupole_debian_package_of(${OpenMesh_DIR}/OpenMeshConfig.cmake openmesh)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS ${openmesh})
endif()

find_package(Python3 REQUIRED COMPONENTS Interpreter)
math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-octupole)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "frame fields on meshes, for Python\n${about} the module octupole.")

# What every package has. The day of the release is that of CHANGELOG.md.
string(REPLACE "." "\\." version "${PROJECT_VERSION}")
file(STRINGS ${PROJECT_SOURCE_DIR}/CHANGELOG.md release REGEX "^## \\[${version}\\] - ")
string(REGEX MATCH "[0-9-]+$" day "${release}")
execute_process(COMMAND date --utc --rfc-email --date=${day} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
foreach(component package IN ZIP_LISTS CPACK_COMPONENTS_ALL packages)
  set(folder ${PROJECT_BINARY_DIR}/debian/${package})
  file(WRITE ${folder}/changelog.Debian "octupole (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n"
       "  * Release ${PROJECT_VERSION}; changelog.gz says what is new.\n\n"
       " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  configure_file(CHANGELOG.md ${folder}/changelog COPYONLY)
  execute_process(COMMAND gzip --best --no-name --force ${folder}/changelog.Debian ${folder}/changelog
                  COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${folder}/changelog.Debian.gz ${folder}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR}/../${package}
          COMPONENT ${component})
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR}/../${package} RENAME copyright COMPONENT ${component})
endforeach()
install(CODE "file(GLOB pages \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1/*.1\")
  if(pages)
    execute_process(COMMAND gzip --best --no-name --force \${pages} COMMAND_ERROR_IS_FATAL ANY)
  endif()" COMPONENT command)

include(CPack)
