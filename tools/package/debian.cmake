# SPDX-License-Identifier: GPL-3.0-or-later
# The Debian packages, made by CPack: `earthtop` of the component `program`, `libearthtop-dev` of `development`, and, where the
# extension is built, `python3-earthtop` of `python`. See tools/package.sh.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME earthtop)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE 0local1) # lower than any revision that a distribution gives to the same version
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# The maintainer is whoever builds the packages, by the variables that Debian's own tools read.
set(CPACK_PACKAGE_CONTACT "The earthtop authors <earthtop@earthtop.invalid>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()

# Each package has two components: the files that are installed everywhere, and those that only Debian needs.
set(packages program:earthtop development:libearthtop-dev)
if(TARGET earthtop-python)
  list(APPEND packages python:python3-earthtop)
endif()
set(CPACK_COMPONENTS_ALL "")
foreach(pair IN LISTS packages)
  string(REGEX REPLACE ":.*" "" component ${pair})
  list(APPEND CPACK_COMPONENTS_ALL ${component} ${component}-debian)
  set(CPACK_COMPONENT_${component}_GROUP ${component})
  set(CPACK_COMPONENT_${component}-debian_GROUP ${component})
endforeach()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
foreach(component IN LISTS CPACK_COMPONENTS_ALL) # CPack wants these names in capitals
  string(TOUPPER ${component} capitals)
  set(CPACK_COMPONENT_${capitals}_GROUP ${CPACK_COMPONENT_${component}_GROUP})
endforeach()

set(about "earthtop integrates the motion of a top or gyroscope in a laboratory that
turns with the Earth, and the prediction of a laboratory that does not, and
reports how far the two drift apart, with a bound on the error of that number.
") # in lines, for package managers
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has a summary of its own
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME earthtop)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "precision simulator of spinning tops on the rotating Earth
${about}
It also runs parameter studies, compares methods, results and measurements, and
writes self-contained reports.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libearthtop-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SOURCE earthtop)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "spinning tops on the rotating Earth - development files
${about}
This package has the C++20 headers and the static library, and the files by
which CMake and pkg-config find them.")

# A static library needs the libraries with which it was built, or newer ones. The configuration for CMake runs pkg-config.
set(depends pkgconf)
foreach(library IN LISTS libraries)
  foreach(package IN LISTS ${library}_debian)
    execute_process(COMMAND dpkg-query --show --showformat=\${Version} ${package} OUTPUT_VARIABLE version ERROR_QUIET)
    string(REGEX REPLACE "-[^-]*$" "" version "${version}") # any Debian revision of the same version will do
    if(version)
      list(APPEND depends "${package} (>= ${version})")
    else()
      list(APPEND depends ${package})
    endif()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES depends)
string(JOIN ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ${depends})

# What Debian's policy requires of every package, the copyright and the changelog, compressed without names and times.
set(changes ${PROJECT_SOURCE_DIR}/.github/CHANGELOG.md)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${changes})
file(STRINGS ${changes} releases REGEX "^## \\[[0-9.]+\\] - ")
list(GET releases 0 release)
string(REGEX REPLACE ".* - " "" release_date "${release}")
execute_process(COMMAND date --utc --date=${release_date}T12:00 --rfc-email
                OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(debian_dir ${PROJECT_BINARY_DIR}/debian)
configure_file(changelog.Debian.in ${debian_dir}/changelog.Debian @ONLY)
configure_file(${changes} ${debian_dir}/changelog COPYONLY)
configure_file(${PROJECT_SOURCE_DIR}/README.md ${debian_dir}/README.md COPYONLY)
foreach(file changelog.Debian changelog README.md)
  execute_process(COMMAND gzip -9nkf ${debian_dir}/${file} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
foreach(pair IN LISTS packages)
  string(REPLACE ":" ";" pair ${pair})
  list(POP_FRONT pair component package)
  install(FILES copyright ${debian_dir}/changelog.gz ${debian_dir}/changelog.Debian.gz DESTINATION share/doc/${package}
          COMPONENT ${component}-debian EXCLUDE_FROM_ALL)
endforeach()
install(FILES earthtop.lintian-overrides DESTINATION share/lintian/overrides RENAME earthtop COMPONENT program-debian EXCLUDE_FROM_ALL)
file(CREATE_LINK ../../earthtop/scenarios ${debian_dir}/examples SYMBOLIC) # where Debian users look for examples
install(FILES ${debian_dir}/examples ${debian_dir}/README.md.gz DESTINATION share/doc/earthtop COMPONENT program-debian EXCLUDE_FROM_ALL)

if(TARGET earthtop-python)
  include(python.cmake)
endif()

# CPack strips programs but not libraries; this strips from the libraries what a linker does not need.
install(CODE "
  if(CMAKE_INSTALL_DO_STRIP)
    file(GLOB libraries \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/libearthtop*.a\")
    foreach(library IN LISTS libraries)
      execute_process(COMMAND \"${CMAKE_STRIP}\" --strip-debug --remove-section=.comment --remove-section=.note
                              --enable-deterministic-archives \${library} COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
  endif()" COMPONENT development)

include(CPack)
