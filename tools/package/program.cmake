# SPDX-License-Identifier: GPL-3.0-or-later
# The component `program`: the program, what it prints about itself (man pages, completions, schemas), scenarios and studies.
install(TARGETS earthtop-tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/earthtop COMPONENT program)
# Debian's packages have a copyright file and a compressed README instead.
install(CODE "
  if(NOT \"\$ENV{DESTDIR}\" MATCHES \"/_CPack_Packages/\")
    file(INSTALL ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
         DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}\")
  endif()" COMPONENT program)

if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
  return() # the program cannot run on this machine
endif()
set(pages_dir ${PROJECT_BINARY_DIR}/pages)
add_custom_command(OUTPUT ${pages_dir}/written
  COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/write-pages.sh ${pages_dir} ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:earthtop-tool>
  DEPENDS earthtop-tool ${CMAKE_CURRENT_SOURCE_DIR}/write-pages.sh
  COMMENT "Man pages, completions and schemas, as the program prints them"
  VERBATIM)
add_custom_target(earthtop-pages ALL DEPENDS ${pages_dir}/written)

set(EARTHTOP_ZSH_DIR ${CMAKE_INSTALL_DATADIR}/zsh/site-functions CACHE STRING
    "Where zsh looks for completions; of Debian's packages: share/zsh/vendor-completions")
set(headers Boost::headers CLI11::CLI11 Eigen3::Eigen nlohmann_json::nlohmann_json)
if(EARTHTOP_FMT_COMPILES) # tools/earthtop/fmt_code.cpp
  list(APPEND headers fmt::fmt)
endif()
list_of_linked(earthtop-tool earthtop ${PROJECT_BINARY_DIR}/earthtop.spdx.json HEADERS ${headers})
if(TARGET earthtop-static)
  list_of_linked(earthtop-static earthtop ${PROJECT_BINARY_DIR}/earthtop-static.spdx.json HEADERS ${headers})
endif()
if(TARGET earthtop-tool-list)
  install(FILES ${PROJECT_BINARY_DIR}/earthtop.spdx.json DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
endif()

install(DIRECTORY ${pages_dir}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
install(FILES ${pages_dir}/earthtop.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME earthtop
        COMPONENT program)
install(FILES ${pages_dir}/earthtop.zsh DESTINATION ${EARTHTOP_ZSH_DIR} RENAME _earthtop COMPONENT program)
install(FILES ${pages_dir}/earthtop.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
install(DIRECTORY ${pages_dir}/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/earthtop COMPONENT program)
