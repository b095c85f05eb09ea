// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "fuzz/door.hpp"

namespace earthtop::fuzz {
namespace {

constexpr Door kDoors[] = {
    {"scenario", enter_scenario, scenario_seeds},
    {"angle-table", enter_angle_table, angle_table_seeds},
    {"study", enter_study, study_seeds},
    {"mapping", enter_mapping, mapping_seeds},
    {"tolerances", enter_tolerances, tolerances_seeds},
    {"measurement", enter_measurement, measurement_seeds},
    {"foreign-rows", enter_foreign_rows, foreign_rows_seeds},
    {"results", enter_results, results_seeds},
    {"run-page", enter_run_page, results_seeds},
    {"reference", enter_reference, reference_seeds},
    {"comparison-document", enter_document, comparison_document_seeds},
    {"bench-document", enter_document, bench_document_seeds},
    {"measurement-document", enter_document, measurement_document_seeds},
    {"plan-document", enter_document, plan_document_seeds},
    {"store", enter_store, store_seeds},
    {"store-repair", enter_repair, store_seeds},
    {"page-text", enter_page_text, page_text_seeds},
};

}  // namespace

std::span<const Door> doors() { return kDoors; }

const Door& door(std::string_view name) {
  for (const Door& known : kDoors)
    if (known.name == name) return known;
  throw std::invalid_argument("no such door: " + std::string(name));
}

}  // namespace earthtop::fuzz
