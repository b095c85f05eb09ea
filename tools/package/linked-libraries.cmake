# SPDX-License-Identifier: GPL-3.0-or-later
# The libraries that earthtop is built on: their names, their packages, their licences; and the lists of what is linked that are
# installed with the program and with the Python package.

# A target or library as CMake links it | its pkg-config module, or flags for the linker | its Debian development packages
# (patterns; zlib's, because sqlite3.pc names it, and SQLite's package does not depend on it) |
# its file without lib, .so and .a (a pattern; none where it is headers alone) | its licence, as SPDX writes it
set(known_libraries
  "Boost::headers||libboost[0-9]*-dev||BSL-1.0"
  "CLI11::CLI11||libcli11-dev||BSD-3-Clause"
  "Eigen3::Eigen|eigen3|libeigen3-dev||MPL-2.0"
  "nlohmann_json::nlohmann_json||nlohmann-json3-dev||MIT"
  "pybind11::module||pybind11-dev||BSD-3-Clause"
  "Python::Module||python3-dev||PSF-2.0"
  "Python::NumPy||python3-numpy||BSD-3-Clause"
  "GSL::gsl|gsl|libgsl-dev|gsl|GPL-3.0-or-later"
  "GSL::gslcblas|gsl|libgsl-dev|gslcblas|GPL-3.0-or-later"
  "fmt::fmt|fmt|libfmt-dev|fmt|MIT"
  "PkgConfig::MD|libmd|libmd-dev|md|BSD-3-Clause AND BSD-2-Clause AND ISC AND Beerware"
  "PkgConfig::XXHASH|libxxhash|libxxhash-dev|xxhash|BSD-2-Clause"
  "PkgConfig::ERFA|erfa|liberfa-dev|erfa|BSD-3-Clause"
  "PkgConfig::SLEEF|sleef|libsleef-dev|sleef|BSL-1.0"
  "SQLite::SQLite3|sqlite3|libsqlite3-dev zlib1g-dev|sqlite3|blessing"
  "GeographicLib::GeographicLib|geographiclib|libgeographiclib-dev|GeographicLib|MIT"
  "Threads::Threads|-pthread||pthread|LGPL-2.1-or-later"
  "quadmath|-lquadmath||quadmath|LGPL-2.1-or-later"
  # what a compiler adds by itself
  "|||c|LGPL-2.1-or-later"
  "|||m|LGPL-2.1-or-later"
  "|||ld-linux.*|LGPL-2.1-or-later"
  "|||gcc_s|GPL-3.0-or-later WITH GCC-exception-3.1"
  "|||gcc_eh|GPL-3.0-or-later WITH GCC-exception-3.1"
  "|||stdc[+][+]|GPL-3.0-or-later WITH GCC-exception-3.1"
  # MPI and SUNDIALS, which are given as files, and what Open MPI brings along
  "|||sundials_.*|BSD-3-Clause"
  "|||mpich|mpich2"
  "|||mpi|BSD-3-Clause-Open-MPI"
  "|||open-.*|BSD-3-Clause-Open-MPI"
  "|||hwloc|BSD-3-Clause"
  "|||event_.*|BSD-3-Clause"
  "|||udev|LGPL-2.1-or-later"
  "|||z|Zlib")

# stop_if_missing(TARGETS...) stops, naming all of these targets that were not found, and what of Debian has them.
function(stop_if_missing)
  set(lacking "")
  set(packages "")
  foreach(entry IN LISTS known_libraries)
    string(REPLACE "|" ";" entry "${entry}")
    list(POP_FRONT entry target module debian)
    if(target IN_LIST ARGN AND NOT TARGET ${target})
      string(REGEX REPLACE "\\[[^]]*\\][*]" "" debian "${debian}") # any version of Boost
      string(REPLACE "PkgConfig::" "" name ${target})
      list(APPEND lacking ${name})
      string(REPLACE " " ";" debian "${debian}")
      list(APPEND packages ${debian})
    endif()
  endforeach()
  if(lacking)
    find_program(EARTHTOP_PKG_CONFIG NAMES pkgconf pkg-config)
    mark_as_advanced(EARTHTOP_PKG_CONFIG)
    if(NOT EARTHTOP_PKG_CONFIG) # without which some are not found
      list(APPEND lacking pkg-config)
      list(APPEND packages pkg-config)
    endif()
    list(JOIN lacking ", " lacking)
    list(JOIN packages " " packages)
    message(FATAL_ERROR "Not found, or too old (README.md has the versions): ${lacking}.\nOn Debian:\n"
                        "  apt-get install --no-install-recommends ${packages}\n")
  endif()
endfunction()

# linked_libraries(LIBRARY) sets LIBRARY_modules, LIBRARY_flags, LIBRARY_debian, and LIBRARY_public_modules: the modules whose
# headers the library's own headers include. A library that is missing in the table stops the configuration, because packages
# would lack a dependency.
function(linked_libraries library)
  set(modules "")
  set(public_modules "")
  set(flags "")
  set(debian "")
  get_target_property(links ${library} INTERFACE_LINK_LIBRARIES)
  foreach(link IN LISTS links)
    set(is_public TRUE)
    if(link MATCHES "^\\$<LINK_ONLY:(.*)>$") # the private dependencies of a static library
      set(link "${CMAKE_MATCH_1}")
      set(is_public FALSE)
    endif()
    if(link MATCHES "^\\$<BUILD_INTERFACE:" OR NOT link)
      continue() # of no concern to the installed library
    endif()
    if(link MATCHES "^(earthtop::)?earthtop$")
      list(APPEND modules earthtop)
      list(APPEND public_modules earthtop)
    elseif(IS_ABSOLUTE "${link}") # MPI and SUNDIALS are given as files
      list(APPEND flags ${link})
      file(REAL_PATH "${link}" file)
      foreach(path "${link}" "${file}") # a link of Debian's alternatives leads to the file of a package
        execute_process(COMMAND dpkg-query --search ${path} OUTPUT_VARIABLE owner ERROR_QUIET RESULT_VARIABLE failed)
        if(NOT failed AND owner MATCHES "^([a-z0-9+.-]+-dev)[:,]")
          list(APPEND debian ${CMAKE_MATCH_1})
        endif()
      endforeach()
    else()
      set(known FALSE)
      foreach(entry IN LISTS known_libraries)
        string(REPLACE "|" ";" entry "${entry}")
        list(POP_FRONT entry target module package)
        if(NOT target STREQUAL link)
          continue()
        endif()
        set(known TRUE)
        string(REPLACE " " ";" package "${package}")
        list(APPEND debian ${package})
        if(module MATCHES "^-")
          list(APPEND flags ${module})
        else()
          list(APPEND modules ${module})
          if(is_public)
            list(APPEND public_modules ${module})
          endif()
        endif()
      endforeach()
      if(NOT known)
        message(FATAL_ERROR "${library} is linked with ${link}, which tools/package/linked-libraries.cmake does not know.")
      endif()
    endif()
  endforeach()
  foreach(list modules public_modules flags debian)
    list(REMOVE_DUPLICATES ${list})
    set(${library}_${list} "${${list}}" PARENT_SCOPE)
  endforeach()
endfunction()

# find_archives(OUT NAMES...): the archives of these libraries, as far as there are any. They are looked for where CMake looks for libraries,
# and where the compiler has its own.
function(find_archives out)
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libstdc++.a OUTPUT_VARIABLE of_compiler OUTPUT_STRIP_TRAILING_WHITESPACE)
  cmake_path(GET of_compiler PARENT_PATH of_compiler)
  set(archives "")
  foreach(library IN LISTS ARGN)
    find_library(EARTHTOP_STATIC_${library} NAMES lib${library}.a HINTS ${of_compiler})
    mark_as_advanced(EARTHTOP_STATIC_${library})
    if(EARTHTOP_STATIC_${library})
      list(APPEND archives ${EARTHTOP_STATIC_${library}})
    endif()
  endforeach()
  set(${out} "${archives}" PARENT_SCOPE)
endfunction()

# link_archives(TARGET NAMES...) links TARGET with earthtop::workbench, and for these libraries with their archives; with the shared
# library where there is none. Its property EARTHTOP_ARCHIVES says which were found. A name may also be an archive that this build makes.
function(link_archives target)
  set(made ${ARGN})
  set(names ${ARGN})
  list(FILTER made INCLUDE REGEX "/")
  list(FILTER names EXCLUDE REGEX "/")
  find_archives(archives ${names})
  list(APPEND archives ${made})
  # What comes after the group is only linked where it is still needed: the shared library of an archive is not.
  target_link_libraries(${target} PRIVATE
    -Wl,--start-group $<TARGET_FILE:earthtop::workbench> $<TARGET_FILE:earthtop::earthtop> ${archives}
    -Wl,--end-group -Wl,--as-needed earthtop::workbench)
  set_target_properties(${target} PROPERTIES EARTHTOP_ARCHIVES "${archives}")
endfunction()

# sleef_archive(TARGET OUT): an archive of SLEEF, of which Debian has none, made before TARGET is linked: the functions that the library
# calls, transcribed from the machine code of the shared library, so that they give the same bits.
function(sleef_archive target out)
  set(tools ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..)
  find_library(EARTHTOP_SHARED_SLEEF NAMES libsleef.so REQUIRED)
  mark_as_advanced(EARTHTOP_SHARED_SLEEF)
  if(NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    message(FATAL_ERROR "Without a libsleef.a this is made for x86-64 alone, not for ${CMAKE_SYSTEM_PROCESSOR}")
  endif()
  set(made ${CMAKE_CURRENT_BINARY_DIR}/${target}-sleef)
  add_custom_command(OUTPUT ${made}/libsleef.a
    COMMAND ${CMAKE_COMMAND} -E make_directory ${made}
    COMMAND python3 ${tools}/play/engine/transcribe_sleef.py ${tools}/../src/elementary.cpp ${EARTHTOP_SHARED_SLEEF} > ${made}/sleef.c
    COMMAND ${CMAKE_CXX_COMPILER} -x c -std=gnu11 -O2 -fPIC -ffp-contract=off -fvisibility=hidden -c ${made}/sleef.c -o ${made}/sleef.o
    COMMAND ${CMAKE_AR} rcsD ${made}/libsleef.a ${made}/sleef.o
    DEPENDS ${tools}/play/engine/transcribe_sleef.py ${tools}/../src/elementary.cpp ${EARTHTOP_SHARED_SLEEF}
    COMMENT "An archive of SLEEF"
    VERBATIM)
  add_custom_target(${target}-sleef DEPENDS ${made}/libsleef.a)
  add_dependencies(${target} ${target}-sleef)
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${made}/libsleef.a)
  set(${out} ${made}/libsleef.a PARENT_SCOPE)
endfunction()

# list_of_linked(TARGET NAME LIST HEADERS NAMES...) makes a target TARGET-list, which writes LIST, what of other libraries
# TARGET is made of, as SPDX: libraries of headers alone, by their names in the table; archives; and what the finished file says that it
# loads. A library that is missing in the table stops the build. With sanitizers, whose libraries are not there, and for another
# processor, whose packages are not installed here, no list is made.
function(list_of_linked target name list)
  cmake_parse_arguments(PARSE_ARGV 3 "" "" "" "HEADERS")
  if(EARTHTOP_SANITIZE OR CMAKE_CROSSCOMPILING)
    return()
  endif()
  get_target_property(archives ${target} EARTHTOP_ARCHIVES)
  if(NOT archives)
    set(archives "")
  endif()
  string(REGEX REPLACE "/usr/.*" "" python_root "${pybind11_DIR}") # of a Python of another Debian
  find_package(Git QUIET)
  set(directory ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  execute_process(COMMAND ${CMAKE_COMMAND} -E env TZ=UTC ${GIT_EXECUTABLE} -C ${directory} log -1 --format=%cd
                          --date=format-local:%Y-%m-%dT%H:%M:%SZ
                  OUTPUT_VARIABLE created OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(STRINGS ${directory}/../../CMakeLists.txt version REGEX "^project\\(earthtop VERSION")
  string(REGEX MATCH "[0-9.]+" version "${version}")
  add_custom_command(OUTPUT ${list}
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DVERSION=${version} -DCREATED=${created} -DLINKED=$<TARGET_FILE:${target}>
            -DOBJDUMP=${CMAKE_OBJDUMP} "-DHEADERS=${_HEADERS}" "-DSTATIC=${archives}" "-DPYTHON_ROOT=${python_root}" -DLIST=${list} -P ${directory}/spdx.cmake
    DEPENDS ${target} ${directory}/linked-libraries.cmake ${directory}/spdx.cmake
    COMMENT "What ${target} is linked with, as SPDX"
    VERBATIM)
  add_custom_target(${target}-list ALL DEPENDS ${list})
endfunction()
