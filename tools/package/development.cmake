# SPDX-License-Identifier: GPL-3.0-or-later
# The component `development`: static libraries, headers, and the files by which CMake and pkg-config find them.
include(CMakePackageConfigHelpers)

set(libraries earthtop)
if(TARGET earthtop-workbench)
  list(APPEND libraries earthtop-workbench)
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/earthtop)
foreach(library IN LISTS libraries) # one file per library, so that each can be found without the dependencies of the others
  install(TARGETS ${library} EXPORT ${library}-targets ARCHIVE COMPONENT development)
  install(EXPORT ${library}-targets NAMESPACE earthtop:: DESTINATION ${package_dir} COMPONENT development)
endforeach()
configure_package_config_file(${PROJECT_SOURCE_DIR}/src/earthtop-config.cmake.in ${PROJECT_BINARY_DIR}/earthtop-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/earthtop-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/earthtop-config.cmake ${PROJECT_BINARY_DIR}/earthtop-config-version.cmake
        DESTINATION ${package_dir} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/earthtop DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.hpp")

# One pkg-config file per library, with the requirements that the library's target passes on to its users.
file(RELATIVE_PATH up /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
string(REGEX REPLACE "/$" "" up "${up}")
foreach(library IN LISTS libraries)
  linked_libraries(${library})
  get_target_property(compile_options ${library} INTERFACE_COMPILE_OPTIONS)
  get_target_property(definitions ${library} INTERFACE_COMPILE_DEFINITIONS)
  set(options "")
  if(compile_options)
    list(APPEND options ${compile_options})
  endif()
  if(definitions)
    list(TRANSFORM definitions PREPEND -D)
    list(APPEND options ${definitions})
  endif()
  string(JOIN " " options ${options})
  string(JOIN " " flags ${${library}_flags})
  string(JOIN ", " public_modules ${${library}_public_modules})
  list(REMOVE_ITEM ${library}_modules ${${library}_public_modules})
  string(JOIN ", " modules ${${library}_modules})
  configure_file(library.pc.in ${PROJECT_BINARY_DIR}/${library}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${library}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endforeach()
