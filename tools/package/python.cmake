# SPDX-License-Identifier: GPL-3.0-or-later
# The Debian package `python3-earthtop` of the component `python`, which tools/python/CMakeLists.txt installs, and of what only
# Debian needs: the package's metadata, manual and notebooks, and byte code that is made when it is installed.
set(python_dir ${PROJECT_SOURCE_DIR}/tools/python)
foreach(variable Python_EXECUTABLE Python_VERSION_MAJOR Python_VERSION_MINOR pybind11_DIR EARTHTOP_NUMPY_FROM EARTHTOP_NUMPY_BELOW)
  get_directory_property(${variable} DIRECTORY ${python_dir} DEFINITION ${variable})
endforeach()

set(metadata_dir ${debian_dir}/python-metadata)
add_custom_command(OUTPUT ${metadata_dir}/written
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${metadata_dir}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${metadata_dir}
  COMMAND ${CMAKE_COMMAND} -E env pybind11_DIR=${pybind11_DIR}
          ${Python_EXECUTABLE} -c "import setuptools.build_meta, sys; setuptools.build_meta.prepare_metadata_for_build_wheel(sys.argv[1])"
          ${metadata_dir} > ${metadata_dir}.log
  COMMAND ${CMAKE_COMMAND} -E touch ${metadata_dir}/written
  DEPENDS ${python_dir}/pyproject.toml ${python_dir}/setup.py ${python_dir}/found.cmake ${python_dir}/needs/CMakeLists.txt ${python_dir}/README.md ${PROJECT_SOURCE_DIR}/CMakeLists.txt
  WORKING_DIRECTORY ${python_dir}
  COMMENT "The Python package's metadata, as a wheel has them (needs python3-setuptools and python3-wheel)"
  VERBATIM)
add_custom_target(earthtop-python-metadata DEPENDS ${metadata_dir}/written)
add_dependencies(packaged earthtop-python-metadata)
install(DIRECTORY ${metadata_dir}/ DESTINATION ${EARTHTOP_PYTHON_DIR} COMPONENT python-debian EXCLUDE_FROM_ALL
        FILES_MATCHING PATTERN "METADATA" PATTERN "*.egg-info" EXCLUDE)

configure_file(${python_dir}/README.md ${debian_dir}/python-manual/README.md COPYONLY)
execute_process(COMMAND gzip -9nkf ${debian_dir}/python-manual/README.md COMMAND_ERROR_IS_FATAL ANY)
install(FILES ${debian_dir}/python-manual/README.md.gz DESTINATION share/doc/python3-earthtop COMPONENT python-debian EXCLUDE_FROM_ALL)
install(DIRECTORY ${python_dir}/examples DESTINATION share/doc/python3-earthtop COMPONENT python-debian EXCLUDE_FROM_ALL)

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-earthtop)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SOURCE earthtop)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/python/postinst ${CMAKE_CURRENT_LIST_DIR}/python/prerm)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "spinning tops on the rotating Earth - Python package
${about}
This package has the Python module earthtop: scenarios, runs as NumPy arrays,
parameter studies, fits and plans of measurements, and the closed forms.")

# An extension fits one version of Python, and the NumPy that the wheel says, too.
math(EXPR next "${Python_VERSION_MINOR} + 1")
set(needed "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}~)" "python3 (<< ${Python_VERSION_MAJOR}.${next})"
           "python3-numpy (>= 1:${EARTHTOP_NUMPY_FROM})")
if(EARTHTOP_NUMPY_BELOW)
  list(APPEND needed "python3-numpy (<< 1:${EARTHTOP_NUMPY_BELOW})")
endif()
string(JOIN ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ${needed})
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, python3-pandas")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-mpmath, libearthtop-dev")
