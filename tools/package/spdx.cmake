# SPDX-License-Identifier: GPL-3.0-or-later
# Writes what of other libraries a linked file is made of, with versions and licences, as SPDX 2.3. Versions are those of the Debian packages
# on this machine. The same file on the same machine gives the same bytes: the time is that of the commit, or SOURCE_DATE_EPOCH.
#   cmake -DNAME=... -DVERSION=... -DCREATED=... -DLINKED=FILE -DOBJDUMP=... -DHEADERS=... -DSTATIC=... -DPYTHON_ROOT=... -DLIST=FILE -P spdx.cmake
# See list_of_linked() in linked-libraries.cmake.
cmake_policy(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/linked-libraries.cmake)
if(DEFINED ENV{SOURCE_DATE_EPOCH} OR NOT CREATED)
  string(TIMESTAMP CREATED "%Y-%m-%dT%H:%M:%SZ" UTC)
endif()

set(distribution debian)
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release distribution REGEX "^ID=")
  string(REGEX REPLACE "^ID=|\"" "" distribution "${distribution}")
endif()
set(packages "")
set(relationships "")

# add(NAME LICENCE DEBIAN RELATIONSHIP): DEBIAN is the installed package with its version and architecture, "" where there is none
function(add name licence debian relationship)
  string(REGEX REPLACE "[^A-Za-z0-9.-]" "-" id "${name}")
  set(version "")
  set(place "")
  if(debian)
    list(POP_FRONT debian package debian_version architecture)
    set(version "\n      \"versionInfo\": \"${debian_version}\",")
    string(REPLACE "+" "%2B" debian_version "${debian_version}")
    string(REPLACE ":" "%3A" debian_version "${debian_version}")
    set(place ",\n      \"externalRefs\": [
        {
          \"referenceCategory\": \"PACKAGE-MANAGER\",
          \"referenceType\": \"purl\",
          \"referenceLocator\": \"pkg:deb/${distribution}/${package}@${debian_version}?arch=${architecture}\"
        }
      ]")
  endif()
  set(packages "${packages},
    {
      \"name\": \"${name}\",
      \"SPDXID\": \"SPDXRef-${id}\",${version}
      \"downloadLocation\": \"NOASSERTION\",
      \"filesAnalyzed\": false,
      \"licenseConcluded\": \"${licence}\",
      \"licenseDeclared\": \"${licence}\",
      \"copyrightText\": \"NOASSERTION\"${place}
    }" PARENT_SCOPE)
  set(relationships "${relationships},
    { \"spdxElementId\": \"SPDXRef-${NAME}\", \"relationshipType\": \"${relationship}\", \"relatedSpdxElement\": \"SPDXRef-${id}\" }"
      PARENT_SCOPE)
endfunction()

# The licence of a library file and its Debian package, by the table; "" if it is not there.
function(licence_of out file)
  get_filename_component(name ${file} NAME)
  string(REGEX REPLACE "^lib|[.](a|so[.0-9]*)$|-[0-9.]+[.]so[.0-9]*$" "" stem ${name})
  set(${out} "" PARENT_SCOPE)
  set(${out}_package "" PARENT_SCOPE)
  foreach(entry IN LISTS known_libraries)
    string(REPLACE "|" ";" entry "${entry}")
    list(GET entry 3 pattern)
    if(pattern AND stem MATCHES "^${pattern}$")
      list(GET entry 4 licence)
      list(GET entry 2 debian)
      set(${out} "${licence}" PARENT_SCOPE)
      set(${out}_package "${debian}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()

# What was compiled in, archives, what is loaded at once, and what these load themselves.
set(patterns "")
foreach(entry IN LISTS known_libraries)
  string(REPLACE "|" ";" entry "${entry}")
  list(POP_FRONT entry target module debian pattern licence)
  if(target IN_LIST HEADERS)
    list(APPEND patterns ${debian})
  endif()
endforeach()
execute_process(COMMAND ${OBJDUMP} -p ${LINKED} OUTPUT_VARIABLE headers COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "NEEDED +[^\n]+" loaded "${headers}")
list(TRANSFORM loaded REPLACE "NEEDED +" "")
set(CMAKE_GET_RUNTIME_DEPENDENCIES_PLATFORM linux+elf)
set(CMAKE_GET_RUNTIME_DEPENDENCIES_TOOL objdump)
set(CMAKE_GET_RUNTIME_DEPENDENCIES_COMMAND ${OBJDUMP})
file(GET_RUNTIME_DEPENDENCIES LIBRARIES ${LINKED} RESOLVED_DEPENDENCIES_VAR files UNRESOLVED_DEPENDENCIES_VAR nowhere)
list(APPEND files ${STATIC})
list(SORT files)

# owner_FILE: the Debian package that a file is of. Packages may know it under /lib or /usr/lib, or by the name that links lead to.
set(paths "")
foreach(file IN LISTS files)
  file(REAL_PATH ${file} real)
  foreach(path ${file} ${real})
    string(REGEX REPLACE "^/usr/" "/" path ${path})
    list(APPEND paths ${path} /usr${path})
    set(file_of_${path} ${file})
    set(file_of_/usr${path} ${file})
  endforeach()
endforeach()
execute_process(COMMAND dpkg-query --search ${paths} OUTPUT_VARIABLE lines ERROR_QUIET)
string(REGEX MATCHALL "[^\n]+" lines "${lines}")
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ ,]+): (/.+)$")
    set(owner_${file_of_${CMAKE_MATCH_2}} ${CMAKE_MATCH_1})
    list(APPEND patterns ${CMAKE_MATCH_1})
  endif()
endforeach()
foreach(file IN LISTS files) # an archive that this build has made is of the version of the library from which it is made
  if(NOT owner_${file})
    licence_of(licence ${file})
    set(owner_${file} "${licence_package}")
    list(APPEND patterns ${licence_package})
  endif()
endforeach()
set(format "\${db:Status-Status} \${Package} \${Version} \${Architecture}\\n")
execute_process(COMMAND dpkg-query --show "--showformat=${format}" ${patterns} OUTPUT_VARIABLE lines ERROR_QUIET)
if(PYTHON_ROOT) # where another Debian's Python is, and its pybind11
  execute_process(COMMAND dpkg-query --admindir=${PYTHON_ROOT}/var/lib/dpkg --show "--showformat=${format}" pybind11-dev
                  OUTPUT_VARIABLE other ERROR_QUIET)
  string(REGEX REPLACE "installed pybind11-dev [^\n]*\n" "" lines "${lines}")
  string(APPEND lines "${other}")
endif()
string(REGEX MATCHALL "[^\n]+" installed "${lines}")
list(FILTER installed INCLUDE REGEX "^installed ")
function(installed_package out pattern)
  string(REGEX REPLACE ":[^:]*$" "" pattern "${pattern}") # without its architecture
  string(REPLACE "*" ".*" pattern "${pattern}")
  string(REPLACE "+" "[+]" pattern "${pattern}")
  set(found ${installed})
  list(FILTER found INCLUDE REGEX "^installed ${pattern} ")
  set(${out} "" PARENT_SCOPE)
  if(found)
    list(GET found 0 found)
    string(REGEX REPLACE "^installed " "" found "${found}")
    string(REPLACE " " ";" found "${found}")
    set(${out} "${found}" PARENT_SCOPE)
  endif()
endfunction()

foreach(entry IN LISTS known_libraries)
  string(REPLACE "|" ";" entry "${entry}")
  list(POP_FRONT entry target module debian pattern licence)
  if(target IN_LIST HEADERS)
    installed_package(package "${debian}")
    string(REGEX REPLACE "::.*" "" name ${target})
    add(${name} "${licence}" "${package}" CONTAINS)
  endif()
endforeach()
foreach(file IN LISTS files nowhere)
  get_filename_component(name ${file} NAME)
  licence_of(licence ${file})
  set(relationship DEPENDS_ON)
  if(name MATCHES "[.]a$")
    set(relationship STATIC_LINK)
  elseif(name IN_LIST loaded)
    set(relationship DYNAMIC_LINK)
  endif()
  if(NOT licence)
    if(NOT relationship STREQUAL "DEPENDS_ON")
      message(FATAL_ERROR "${NAME} is linked with ${name}, which tools/package/linked-libraries.cmake does not know.")
    endif()
    set(licence NOASSERTION)
  endif()
  installed_package(package "${owner_${file}}")
  add(${name} "${licence}" "${package}" ${relationship})
endforeach()

string(SHA256 hash "${packages}${relationships}")
file(WRITE ${LIST} "{
  \"spdxVersion\": \"SPDX-2.3\",
  \"dataLicense\": \"CC0-1.0\",
  \"SPDXID\": \"SPDXRef-DOCUMENT\",
  \"name\": \"${NAME}-${VERSION}\",
  \"documentNamespace\": \"https://earthtop.invalid/spdx/${NAME}-${VERSION}-${hash}\",
  \"creationInfo\": { \"created\": \"${CREATED}\", \"creators\": [\"Organization: The earthtop authors\"] },
  \"packages\": [
    {
      \"name\": \"${NAME}\",
      \"SPDXID\": \"SPDXRef-${NAME}\",
      \"versionInfo\": \"${VERSION}\",
      \"downloadLocation\": \"NOASSERTION\",
      \"filesAnalyzed\": false,
      \"licenseConcluded\": \"GPL-3.0-or-later\",
      \"licenseDeclared\": \"GPL-3.0-or-later\",
      \"copyrightText\": \"2026 The earthtop authors\"
    }${packages}
  ],
  \"relationships\": [
    { \"spdxElementId\": \"SPDXRef-DOCUMENT\", \"relationshipType\": \"DESCRIBES\", \"relatedSpdxElement\": \"SPDXRef-${NAME}\" }${relationships}
  ]
}
")
