// SPDX-License-Identifier: GPL-3.0-or-later
/// The doors through which a text or a file enters the program, each with the properties that must hold for any bytes. A fuzzer
/// (fuzz.cpp) and a test that replays kept inputs (replay_test.cpp) go through the same table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace earthtop::fuzz {

/// Separates the parts of an input where a door takes several; it occurs in no JSON or CSV text.
inline constexpr char kBetweenParts = '\x01';

struct Door {
  std::string_view name;
  /// Lets the bytes in. @throws Broken where a property does not hold; anything but the documented exceptions, which it catches
  void (*enter)(std::string_view input);
  std::vector<std::string> (*seeds)();
  /// Changes an input that stays of its kind; empty where it is of none. @param seed  the same one makes the same change
  std::string (*mutated)(std::string_view input, std::uint32_t seed);
};

std::span<const Door> doors();
/// @throws std::invalid_argument for an unknown name
const Door& door(std::string_view name);

// The entrances, by source file.
void enter_scenario(std::string_view input);
void enter_angle_table(std::string_view input);
void enter_study(std::string_view input);
void enter_mapping(std::string_view input);
void enter_tolerances(std::string_view input);
void enter_measurement(std::string_view input);
void enter_foreign_rows(std::string_view input);
void enter_results(std::string_view input);
void enter_run_page(std::string_view input);
void enter_reference(std::string_view input);
void enter_document(std::string_view input);
void enter_page_text(std::string_view input);
void enter_store(std::string_view input);
void enter_repair(std::string_view input);

// The seeds.
std::vector<std::string> scenario_seeds();
std::vector<std::string> angle_table_seeds();
std::vector<std::string> study_seeds();
std::vector<std::string> mapping_seeds();
std::vector<std::string> tolerances_seeds();
std::vector<std::string> measurement_seeds();
std::vector<std::string> foreign_rows_seeds();
std::vector<std::string> results_seeds();
std::vector<std::string> reference_seeds();
std::vector<std::string> comparison_document_seeds();
std::vector<std::string> bench_document_seeds();
std::vector<std::string> measurement_document_seeds();
std::vector<std::string> plan_document_seeds();
std::vector<std::string> page_text_seeds();
std::vector<std::string> store_seeds();
std::vector<std::string> repair_seeds();

}  // namespace earthtop::fuzz
