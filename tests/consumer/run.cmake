# SPDX-License-Identifier: GPL-3.0-or-later
# Installs earthtop, moves the installation (nothing in it may remember where it was), builds the consumer against it and
# runs it on an installed scenario.
#   cmake -DBUILD_DIR=... -DSOURCE_DIR=... -DGENERATOR=... -DCXX=... -DBUILD_TYPE=... -P run.cmake
set(work ${BUILD_DIR}/consumer)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${work}/first-place)
file(RENAME ${work}/first-place ${work}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${work}/build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX}
    -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_PREFIX_PATH=${work}/prefix -DCMAKE_CXX_EXTENSIONS=OFF)
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/consumer ${work}/prefix/share/earthtop/scenarios/toy-top.json)
run(${work}/build/workbench_consumer ${work}/prefix/share/earthtop/scenarios/toy-top.json ${work}/study)

# Who needs the core alone carries nothing of the workbench.
execute_process(COMMAND ldd ${work}/build/consumer OUTPUT_VARIABLE shared COMMAND_ERROR_IS_FATAL ANY)
if(shared MATCHES "sqlite|crypto|mpi|sundials")
  message(FATAL_ERROR "a consumer of the core needs more than the core:\n${shared}")
endif()
