# SPDX-License-Identifier: GPL-3.0-or-later
# Writes OUTPUT, a C++ source that holds the pages' style and scripts as literals, without comments and indentation: a page has all of them
# inside, and a gallery many pages.
function(read_bare name variable)
  file(READ ${DIRECTORY}/${name} text)
  string(REGEX REPLACE "/[*]([^*]|[*]+[^*/])*[*]+/" "" text "${text}")
  string(REGEX REPLACE "\n[ \t]*//[^\n]*" "" text "\n${text}")
  string(REGEX REPLACE "\n[ \t\n]+" "\n" text "${text}")
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

read_bare(page.css style)
# The scripts of a run's page, of a study's, and of every other one.
set(run charts unpack view sphere body top page)
set(study charts study unpack page)
set(other charts unpack page)
set(functions "")
foreach(kind run study other)
  set(script "")
  foreach(name IN LISTS ${kind})
    read_bare(${name}.js part)
    string(APPEND script "${part}")
  endforeach()
  string(APPEND functions "std::string_view ${kind}_script() { return R\"js(${script})js\"; }\n\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"report/assets.hpp\"\n\nnamespace earthtop::report {\n\n"
  "std::string_view page_style() { return R\"css(${style})css\"; }\n\n${functions}}  // namespace earthtop::report\n")
