# SPDX-License-Identifier: GPL-3.0-or-later
# The workbench on top of the core: studies, comparison, measurement and its planning, benchmarks, verification and report pages. Only the
# workbench needs SQLite, and MPI and SUNDIALS if they are installed.
add_library(earthtop-workbench
  bench/bench.cpp
  bench/comparison.cpp
  bench/contenders.cpp
  bench/documents.cpp
  bench/exact_motion.cpp
  bench/figure.cpp
  bench/gsl_peers.cpp
  bench/names.cpp
  bench/peers.cpp
  bench/processor.cpp
  bench/reference.cpp
  bench/write.cpp
  compare/compact_reference.cpp
  compare/common_end.cpp
  compare/comparand.cpp
  compare/comparand_values.cpp
  compare/compare.cpp
  compare/conclusion.cpp
  compare/cost.cpp
  compare/diagnosis.cpp
  compare/document.cpp
  compare/engine_fit.cpp
  compare/evidence.cpp
  compare/explanation.cpp
  compare/fields.cpp
  compare/figure.cpp
  compare/figures.cpp
  compare/hints.cpp
  compare/interpolate.cpp
  compare/junit.cpp
  compare/mapping.cpp
  compare/mistakes.cpp
  compare/pairing.cpp
  compare/physics_search.cpp
  compare/reading.cpp
  compare/replacement.cpp
  compare/row.cpp
  compare/row_source.cpp
  compare/rows.cpp
  compare/scenario_changes.cpp
  compare/snapshot.cpp
  compare/stores.cpp
  compare/survey.cpp
  compare/tolerances.cpp
  compare/trust.cpp
  compare/update.cpp
  measure/columns.cpp
  measure/compared_release.cpp
  measure/document.cpp
  measure/estimated_inputs.cpp
  measure/estimation.cpp
  measure/exact_inputs.cpp
  measure/features.cpp
  measure/figure.cpp
  measure/file.cpp
  measure/findings.cpp
  measure/fit_hints.cpp
  measure/fit_search.cpp
  measure/fitted_scenario.cpp
  measure/influences.cpp
  measure/free_start.cpp
  measure/input_places.cpp
  measure/joint_inputs.cpp
  measure/known_rate.cpp
  measure/measured_motion.cpp
  measure/measured_start.cpp
  measure/measurement.cpp
  measure/prediction_problem.cpp
  measure/priors.cpp
  measure/quantities.cpp
  measure/quotation.cpp
  measure/rate_finding.cpp
  measure/releases_file.cpp
  measure/scaled_problem.cpp
  measure/seen_directions.cpp
  measure/sentences.cpp
  measure/weighted_fit.cpp
  measure/whitening.cpp
  plan/advice.cpp
  plan/bound.cpp
  plan/derivatives.cpp
  plan/document.cpp
  plan/figure.cpp
  plan/optimise.cpp
  plan/plan.cpp
  plan/planned_rows.cpp
  plan/preparation.cpp
  plan/simulate.cpp
  report/bars.cpp
  report/bench_page.cpp
  report/comparison_page.cpp
  report/contact_section.cpp
  report/content_policy.cpp
  report/drift_chart.cpp
  report/drift_section.cpp
  report/exact_inputs_html.cpp
  report/finding.cpp
  report/first_figure.cpp
  report/gallery.cpp
  report/html.cpp
  report/journey_section.cpp
  report/known_html.cpp
  report/measurement_page.cpp
  report/motion_data.cpp
  report/packed.cpp
  report/path_picture.cpp
  report/track_map.cpp
  report/top_still.cpp
  report/plan_page.cpp
  report/report.cpp
  report/run_page.cpp
  report/seen.cpp
  report/study_cells.cpp
  report/study_finding.cpp
  report/study_page.cpp
  report/study_picture.cpp
  report/study_points.cpp
  report/study_words.cpp
  report/thinning.cpp
  study/chunk.cpp
  study/collect.cpp
  study/collectable.cpp
  study/columns.cpp
  study/design.cpp
  study/fields.cpp
  study/figure.cpp
  study/gathering.cpp
  study/growth.cpp
  study/identity.cpp
  study/influence.cpp
  study/json_text.cpp
  study/launcher.cpp
  study/message.cpp
  study/rank_search.cpp
  study/results.cpp
  study/results_fields.cpp
  study/run_study.cpp
  study/selection.cpp
  study/sqlite.cpp
  study/statistics.cpp
  study/store.cpp
  study/store_lock.cpp
  study/study.cpp
  study/study_file.cpp
  study/threads.cpp
  study/timing.cpp
  study/value.cpp
  verify/closed_form.cpp
  verify/differences.cpp
  verify/equivalence.cpp
  verify/exactly_zero.cpp
  verify/invariant.cpp
  verify/order.cpp
  verify/refused.cpp
  verify/runs.cpp
  verify/small_motions.cpp
  verify/special_motions.cpp
  verify/value.cpp
  verify/verdict.cpp
  verify/verify.cpp
)
add_library(earthtop::workbench ALIAS earthtop-workbench)
set_target_properties(earthtop-workbench PROPERTIES EXPORT_NAME workbench)
target_link_libraries(earthtop-workbench
  PUBLIC earthtop
  PRIVATE $<BUILD_INTERFACE:earthtop_compiled> GSL::gsl GSL::gslcblas fmt::fmt SQLite::SQLite3 Threads::Threads)
# Code that reads and writes documents takes a third less time to compile at -O1. Sources that process millions of rows, or
# integrate, are compiled at -O3.
target_compile_options(earthtop-workbench PRIVATE $<$<CONFIG:Release>:-O1>)
if(EARTHTOP_BUILD_FUZZERS)
  target_compile_options(earthtop-workbench PRIVATE -fsanitize=fuzzer-no-link)
endif()
set_source_files_properties(bench/exact_motion.cpp bench/gsl_peers.cpp bench/sundials_peers.cpp
                            compare/interpolate.cpp compare/row.cpp compare/rows.cpp study/rank_search.cpp study/statistics.cpp
                            PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>")
earthtop_unity_rooms(earthtop-workbench "bench;compare;measure;plan;report;study;verify")

# The scripts and styles of a report for the browser.
file(GLOB report_assets CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/report/assets/*)
add_custom_command(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/report_assets.cpp
  COMMAND ${CMAKE_COMMAND} -DDIRECTORY=${CMAKE_CURRENT_SOURCE_DIR}/report/assets -DOUTPUT=${CMAKE_CURRENT_BINARY_DIR}/report_assets.cpp
          -P ${CMAKE_CURRENT_SOURCE_DIR}/report/assets.cmake
  DEPENDS ${report_assets} report/assets.cmake
  VERBATIM)
target_sources(earthtop-workbench PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/report_assets.cpp)

# If MPI is installed, a study can use several machines. (MPI's C++ bindings are obsolete and not used.)
if(EARTHTOP_MPI)
  find_package(MPI QUIET COMPONENTS CXX)
endif()
if(EARTHTOP_MPI AND MPI_CXX_FOUND)
  target_sources(earthtop-workbench PRIVATE study/mpi_processes.cpp)
  set_source_files_properties(study/mpi_processes.cpp PROPERTIES INCLUDE_DIRECTORIES "${MPI_CXX_INCLUDE_DIRS}"
                                                                 COMPILE_DEFINITIONS "OMPI_SKIP_MPICXX;MPICH_SKIP_MPICXX")
  target_link_libraries(earthtop-workbench PRIVATE ${MPI_CXX_LIBRARIES})
  message(STATUS "MPI: mpirun -n N earthtop study")
else()
  target_sources(earthtop-workbench PRIVATE study/single_process.cpp)
  message(STATUS "MPI: not found or not wanted; studies run in threads, or in shards (libopenmpi-dev)")
endif()

# If SUNDIALS is installed, its integrators are peers in `earthtop bench`.
if(EARTHTOP_SUNDIALS)
  find_path(SUNDIALS_INCLUDE_DIR arkode/arkode_erkstep.h)
  set(sundials_libraries "")
  foreach(part cvode arkode nvecserial sunnonlinsolfixedpoint)
    find_library(SUNDIALS_${part}_LIBRARY sundials_${part})
    list(APPEND sundials_libraries ${SUNDIALS_${part}_LIBRARY})
    mark_as_advanced(SUNDIALS_${part}_LIBRARY)
  endforeach()
  mark_as_advanced(SUNDIALS_INCLUDE_DIR)
  if(SUNDIALS_INCLUDE_DIR AND NOT "${sundials_libraries}" MATCHES "NOTFOUND")
    target_sources(earthtop-workbench PRIVATE bench/sundials_peers.cpp)
    set_source_files_properties(bench/peers.cpp PROPERTIES COMPILE_DEFINITIONS EARTHTOP_SUNDIALS)
    if(NOT SUNDIALS_INCLUDE_DIR IN_LIST CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES) # named again, they hide the compiler's own
      set_source_files_properties(bench/sundials_peers.cpp PROPERTIES INCLUDE_DIRECTORIES ${SUNDIALS_INCLUDE_DIR})
    endif()
    target_link_libraries(earthtop-workbench PRIVATE ${sundials_libraries})
    message(STATUS "SUNDIALS: CVODE and ARKODE are peers of earthtop bench")
  else()
    message(STATUS "SUNDIALS: not found, no peer of earthtop bench (libsundials-dev)")
  endif()
endif()

earthtop_precompile_headers(earthtop-workbench REUSE_FROM earthtop_documents)
