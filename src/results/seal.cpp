// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/seal.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "input/document.hpp"
#include "input/file.hpp"
#include "text/checksum.hpp"
#include "text/json.hpp"
#include "text/utf8.hpp"

namespace earthtop {
namespace {

constexpr std::string_view kEnd = "\n}\n", kBefore = ",\n  \"checksum\": \"", kBeforeFiles = ",\n  \"files\": {",
                           kZeros = "0000000000000000";

constexpr const char* kDamaged = "is damaged: it is not what was written, or a run is writing there; run the scenario again";
constexpr const char *kSummaryName = "summary.json", *kTimingName = "timing.json";

std::string checksum_of_file(const std::filesystem::path& file) {
  return checksum_text(input::checksum_of_file(file.string(), {"result file"}));
}

/// A document up to its last member.
std::string without_end(std::string_view document) {
  const std::size_t brace = document.rfind('}');
  const std::size_t last = brace == document.npos ? brace : document.find_last_not_of(" \t\r\n", brace - 1);
  return std::string(document.substr(0, last == document.npos ? 0 : last + 1));
}

}  // namespace

std::string sealed(std::string_view document) {
  std::string text = without_end(document);
  if (text.ends_with('{')) return std::string(document);
  text.append(kBefore).append(kZeros).append("\"").append(kEnd);
  const std::string checksum = checksum_text(checksum_of(text));
  return text.replace(text.size() - kEnd.size() - 1 - kZeros.size(), kZeros.size(), checksum);
}

std::string sealed(std::string_view document, const FileChecksums& files) {
  std::string text = without_end(document);
  if (text.ends_with('{')) return std::string(document);
  text += kBeforeFiles;
  for (std::size_t i = 0; i < files.size(); ++i)
    text += fmt::format("{}\n    \"{}\": \"{}\"", i > 0 ? "," : "", files[i].first, files[i].second);
  text += "\n  }";
  return sealed(text.append(kEnd));
}

std::string sealed_document(const nlohmann::ordered_json& document) {
  return sealed(json_with_escapes(written_replacing(document, 2)) + '\n');
}

std::string resealed(std::string_view document) {
  nlohmann::ordered_json json = json_of(document);
  json.erase("checksum");
  return json.empty() ? std::string(document) : sealed_document(json);
}

std::string unsealed(std::string_view document) {
  const std::size_t checksum = document.rfind(kBefore);
  if (checksum == document.npos) return std::string(document);
  const std::size_t files = document.rfind(kBeforeFiles, checksum);
  // The member "files", whose values have no braces, is the last one before the checksum.
  const bool has_files = files != document.npos && document.find('}', files) == checksum - 1;
  return std::string(document.substr(0, has_files ? files : checksum)).append(kEnd);
}

void refuse_damaged(const std::filesystem::path& file) { refuse_file(file, kDamaged); }

Seal seal_of(std::string_view document) {
  const std::size_t behind = kZeros.size() + 1 + kEnd.size();
  const std::size_t digits = document.size() < kBefore.size() + behind ? 0 : document.size() - behind;
  const std::string_view stated = digits > 0 ? document.substr(digits, kZeros.size()) : std::string_view();
  const bool is_named = digits > 0 && document.substr(digits - kBefore.size(), kBefore.size()) == kBefore;
  if (!is_named) {
    // It had a checksum, which was damaged: digits stand where its own do, or its name stands elsewhere.
    const bool has_digits = !stated.empty() && stated.find_first_not_of("0123456789abcdef") == stated.npos;
    return has_digits || document.find(kBefore) != document.npos ? Seal::broken : Seal::absent;
  }
  std::string text(document);
  text.replace(digits, kZeros.size(), kZeros);
  return checksum_text(checksum_of(text)) == stated ? Seal::fits : Seal::broken;
}

bool check_seal(std::string_view document, const std::filesystem::path& file, std::string_view remedy) {
  const Seal seal = seal_of(document);
  if (seal == Seal::broken) refuse_file(file, fmt::format("is damaged: its contents are not what was written; {}", remedy));
  return seal == Seal::fits;
}

std::string unverified(const std::filesystem::path& path) {
  return fmt::format("{} has no checksums: damage to it would go unnoticed", printable(path.string()));
}

FileChecksums checksums_in(std::string_view summary, const std::filesystem::path& file) {
  FileChecksums checksums;
  const nlohmann::ordered_json json = input::read_document(summary, file.string(), {"summary"});
  const nlohmann::ordered_json files = json.value("files", nlohmann::ordered_json::object());
  if (!files.is_object()) refuse_damaged(file);
  for (const auto& [name, checksum] : files.items()) {
    if (!checksum.is_string() || name.empty() || std::filesystem::path(name).filename() != name) refuse_damaged(file);
    checksums.emplace_back(name, checksum.get<std::string>());
  }
  return checksums;
}

bool is_as_stated(const std::filesystem::path& directory, std::string_view name, std::string_view document) {
  if (seal_of(document) == Seal::absent) return true;
  for (const auto& [stated, checksum] : checksums_in(document, directory))
    if (stated == name) return checksum == checksum_of_file(directory / name);
  return false;
}

bool check_result_files(const std::filesystem::path& directory, std::string_view summary) {
  const Seal seal = seal_of(summary);
  if (seal == Seal::absent) return false;
  if (seal == Seal::broken) refuse_damaged(directory / kSummaryName);
  for (const auto& [name, checksum] : checksums_in(summary, directory / kSummaryName)) {
    const std::filesystem::path file = directory / name;
    if (input::type_of(file.string()) == input::PathType::nothing) continue;  // who needs it says that it is missing
    if (checksum != checksum_of_file(file)) refuse_damaged(file);
  }
  return true;
}

std::string sealed_timing(std::string_view timing, std::string_view summary) {
  return sealed(timing, {{kSummaryName, checksum_text(checksum_of(summary))}});
}

bool check_timing(const std::filesystem::path& directory, std::string_view timing, std::string_view summary) {
  const std::filesystem::path file = directory / kTimingName;
  if (!check_seal(timing, file, "run the scenario again")) return false;
  if (seal_of(summary) == Seal::absent) return true;
  const std::string checksum = checksum_text(checksum_of(summary));
  for (const auto& [name, stated] : checksums_in(timing, file))
    if (name == kSummaryName && stated != checksum)
      refuse_file(file, "belongs to another result than the summary.json beside it; remove it, or run the scenario again");
  return true;
}

}  // namespace earthtop
