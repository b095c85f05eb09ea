# SPDX-License-Identifier: GPL-3.0-or-later
# What the installed static libraries hand on to whoever links them, under its names in pkg-config and in Debian.

# A target or library as CMake links it | its module of pkg-config, or flags for the linker | the Debian package to develop with it
set(known_libraries
  "Eigen3::Eigen|eigen3|libeigen3-dev"
  "GSL::gsl|gsl|libgsl-dev"
  "GSL::gslcblas|gsl|libgsl-dev"
  "fmt::fmt|fmt|libfmt-dev"
  "PkgConfig::MD|libmd|libmd-dev"
  "PkgConfig::ERFA|erfa|liberfa-dev"
  "PkgConfig::SLEEF|sleef|libsleef-dev"
  "SQLite::SQLite3|sqlite3|libsqlite3-dev"
  "GeographicLib::GeographicLib|geographiclib|libgeographiclib-dev"
  "Threads::Threads|-pthread|"
  "quadmath|-lquadmath|")

# linked_libraries(LIBRARY): sets LIBRARY_modules, LIBRARY_flags and LIBRARY_debian, and LIBRARY_public_modules, whose headers the
# library's own include. A library that is missing in the table ends the configuration: packages would lack a dependency.
function(linked_libraries library)
  set(modules "")
  set(public_modules "")
  set(flags "")
  set(debian "")
  get_target_property(links ${library} INTERFACE_LINK_LIBRARIES)
  foreach(link IN LISTS links)
    set(is_public TRUE)
    if(link MATCHES "^\\$<LINK_ONLY:(.*)>$") # what a static library is linked with privately
      set(link "${CMAKE_MATCH_1}")
      set(is_public FALSE)
    endif()
    if(link MATCHES "^\\$<BUILD_INTERFACE:" OR NOT link)
      continue() # nothing that the installed library knows of
    endif()
    if(link MATCHES "^(earthtop::)?earthtop$")
      list(APPEND modules earthtop)
      list(APPEND public_modules earthtop)
    elseif(IS_ABSOLUTE "${link}") # MPI and SUNDIALS are found as files
      list(APPEND flags ${link})
      file(REAL_PATH "${link}" file)
      foreach(path "${link}" "${file}") # behind a link of the alternatives there is a package's file
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
