# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the libraries that earthtop is built on, and stops nowhere: `needed_libraries` are their names in the table of
# linked-libraries.cmake, and stop_if_missing() names at once all that were not found.
include(${CMAKE_CURRENT_LIST_DIR}/linked-libraries.cmake)
find_package(Boost 1.74 QUIET CONFIG)
if(NOT Boost_FOUND) # headers alone, without Boost's own configuration: by CMake's module, which later versions warn about
  find_package(Boost 1.74 QUIET)
endif()
find_package(Eigen3 3.4 QUIET NO_MODULE)
find_package(GSL 2.7 QUIET)
find_package(nlohmann_json 3.11 QUIET)
find_package(fmt 9 QUIET)
find_package(SQLite3 3.40 QUIET)
find_package(Threads REQUIRED)
find_package(PkgConfig QUIET) # ERFA, libmd, SLEEF and xxHash have no CMake packages
if(PkgConfig_FOUND)
  pkg_check_modules(ERFA QUIET IMPORTED_TARGET erfa>=2.0)
  pkg_check_modules(MD QUIET IMPORTED_TARGET libmd>=1.0)
  pkg_check_modules(XXHASH QUIET IMPORTED_TARGET libxxhash>=0.8)
  pkg_check_modules(SLEEF QUIET IMPORTED_TARGET sleef>=3.5) # every sine, exponential and logarithm of a result is a function of it
endif()
list(APPEND CMAKE_MODULE_PATH /usr/share/cmake/geographiclib) # Debian ships only a Find module, in this directory
find_package(GeographicLib QUIET)
if(GeographicLib_FOUND AND NOT TARGET GeographicLib::GeographicLib) # the target of the library's own package; the module only sets variables
  add_library(GeographicLib::GeographicLib INTERFACE IMPORTED)
  target_link_libraries(GeographicLib::GeographicLib INTERFACE ${GeographicLib_LIBRARIES})
  set(GeographicLib_LIBRARIES GeographicLib::GeographicLib)
endif()
set(needed_libraries Boost::headers Eigen3::Eigen GSL::gsl nlohmann_json::nlohmann_json fmt::fmt SQLite::SQLite3 PkgConfig::ERFA PkgConfig::MD
                     PkgConfig::XXHASH PkgConfig::SLEEF GeographicLib::GeographicLib)
if(EARTHTOP_BUILD_TOOLS)
  find_package(CLI11 2.1 QUIET)
  list(APPEND needed_libraries CLI11::CLI11)
endif()
