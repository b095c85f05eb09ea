// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "fuzz/door.hpp"
#include "fuzz/mutation.hpp"

namespace earthtop::fuzz {
namespace {

constexpr Door kDoors[] = {
    {"scenario", enter_scenario, scenario_seeds, mutated_text},
    {"angle-table", enter_angle_table, angle_table_seeds, mutated_text},
    {"study", enter_study, study_seeds, mutated_text},
    {"mapping", enter_mapping, mapping_seeds, mutated_text},
    {"tolerances", enter_tolerances, tolerances_seeds, mutated_text},
    {"measurement", enter_measurement, measurement_seeds, mutated_text},
    {"foreign-rows", enter_foreign_rows, foreign_rows_seeds, mutated_text},
    {"results", enter_results, results_seeds, mutated_results},
    {"run-page", enter_run_page, results_seeds, mutated_results},
    {"reference", enter_reference, reference_seeds, mutated_text},
    {"comparison-document", enter_document, comparison_document_seeds, mutated_text},
    {"bench-document", enter_document, bench_document_seeds, mutated_text},
    {"measurement-document", enter_document, measurement_document_seeds, mutated_text},
    {"plan-document", enter_document, plan_document_seeds, mutated_text},
    {"store", enter_store, store_seeds, mutated_store},
    {"store-repair", enter_repair, repair_seeds, damaged_store},
    {"page-text", enter_page_text, page_text_seeds, mutated_page_text},
};

}  // namespace

std::span<const Door> doors() { return kDoors; }

const Door& door(std::string_view name) {
  for (const Door& known : kDoors)
    if (known.name == name) return known;
  throw std::invalid_argument("no such door: " + std::string(name));
}

}  // namespace earthtop::fuzz
