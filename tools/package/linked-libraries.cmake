# SPDX-License-Identifier: GPL-3.0-or-later
# The libraries that the installed static libraries need when they are linked, under their names in pkg-config and in Debian.

# A target or library as CMake links it | its pkg-config module, or flags for the linker | its Debian development package
set(known_libraries
  "Eigen3::Eigen|eigen3|libeigen3-dev"
  "GSL::gsl|gsl|libgsl-dev"
  "GSL::gslcblas|gsl|libgsl-dev"
  "fmt::fmt|fmt|libfmt-dev"
  "PkgConfig::MD|libmd|libmd-dev"
  "PkgConfig::XXHASH|libxxhash|libxxhash-dev"
  "PkgConfig::ERFA|erfa|liberfa-dev"
  "PkgConfig::SLEEF|sleef|libsleef-dev"
  "SQLite::SQLite3|sqlite3|libsqlite3-dev"
  "GeographicLib::GeographicLib|geographiclib|libgeographiclib-dev"
  "Threads::Threads|-pthread|"
  "quadmath|-lquadmath|")

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
