# SPDX-License-Identifier: GPL-3.0-or-later
# Writes OUTPUT, a C++ source that holds the page's style and script as literals.
file(READ ${DIRECTORY}/page.css style)
set(script "")
foreach(name charts study unpack view sphere body top page)
  file(READ ${DIRECTORY}/${name}.js part)
  string(APPEND script "${part}")
endforeach()
file(WRITE ${OUTPUT} "#include \"report/assets.hpp\"\n\nnamespace earthtop::report {\n\n"
  "std::string_view page_style() { return R\"css(${style})css\"; }\n\n"
  "std::string_view page_script() { return R\"js(${script})js\"; }\n\n}  // namespace earthtop::report\n")
