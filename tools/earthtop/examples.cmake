# SPDX-License-Identifier: GPL-3.0-or-later
# Writes OUTPUT, a C++ source whose FUNCTION returns the scenario files of DIRECTORY, as string literals.
file(GLOB files ${DIRECTORY}/*.json)
list(SORT files)
set(entries "")
foreach(file IN LISTS files)
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND entries "    {\"${name}\", R\"json(${text})json\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"examples.hpp\"\n\nnamespace earthtop::tool {\n\n"
  "std::span<const Example> ${FUNCTION}() {\n  static constexpr Example kFiles[] = {\n${entries}  };\n  return kFiles;\n}\n\n"
  "}  // namespace earthtop::tool\n")
