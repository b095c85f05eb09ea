# SPDX-License-Identifier: GPL-3.0-or-later
# Finds Python, NumPy and pybind11, and says which NumPy an extension needs that is built with them: from EARTHTOP_NUMPY_FROM on and,
# unless it is empty, below EARTHTOP_NUMPY_BELOW. The wheel and the Debian package state it.

# Debian's packages belong to Debian's Python, which need not be the first in the path.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
set(PYBIND11_FINDPYTHON ON)
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
if(Python_FOUND)
  find_package(pybind11 2.10 QUIET)
endif()

set(EARTHTOP_NUMPY_FROM 1.24)
set(EARTHTOP_NUMPY_BELOW "")
if(pybind11_VERSION VERSION_LESS 2.12) # 2.12 is the first that knows NumPy 2
  set(EARTHTOP_NUMPY_BELOW 2)
endif()
