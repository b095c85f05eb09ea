// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/trust.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "earthtop/run.hpp"

namespace earthtop::compare {
namespace {

constexpr double kToTheEnd = std::numeric_limits<double>::infinity();

/// Whether the verdict rests on a doubt of this name: it says that disturbances have grown, or may have. Of the others, some belong to
/// moments that the two motions of a run pass one after the other, and noise is within the bounds.
bool is_of_motion(const std::string& why) {
  const auto* const known =
      std::find_if(std::begin(kDoubts), std::end(kDoubts), [&](const DoubtType& d) { return d.name == why; });
  return known == std::end(kDoubts) || (known->of_verdict && known->doubt != Doubt::noise);
}

/// Joins the times that meet or overlap.
std::vector<Doubted> united(std::vector<Doubted> times) {
  std::stable_sort(times.begin(), times.end(), [](const Doubted& a, const Doubted& b) { return a.from_s < b.from_s; });
  std::vector<Doubted> apart;
  for (const Doubted& time : times)
    if (apart.empty() || time.from_s > apart.back().until_s)
      apart.push_back(time);
    else
      apart.back().until_s = std::max(apart.back().until_s, time.until_s);
  return apart;
}

double trusted_s(const std::vector<Doubted>& doubts, double end_s) {
  double sum = end_s;
  for (const Doubted& doubt : doubts) sum -= std::min(doubt.until_s, end_s) - doubt.from_s;
  return sum;
}

/// "to the end", "until t = 3.2 s", or, of a run that is trusted again later, "for 5 s".
std::string trusted_words(const std::vector<Doubted>& doubts, double end_s) {
  if (doubts.empty()) return "to the end";
  if (doubts.size() == 1 && !(doubts[0].until_s < end_s)) return fmt::format("until t = {:.6g} s", doubts[0].from_s);
  return fmt::format("for {:.6g} s", trusted_s(doubts, end_s));
}

}  // namespace

bool magnifies_rounding(const Comparand& side) {
  const std::string verdict = side.word("/drift/verdict");
  return verdict != to_string(Verdict::reliable) && verdict != to_string(Verdict::noise_floor) && !verdict.empty();
}

std::vector<Doubted> doubts_of(const Comparand& side, double end_s) {
  if (!magnifies_rounding(side)) return {};
  std::vector<Doubted> doubts;
  const Json::json_pointer at("/drift/verdict_intervals");
  if (side.summary->contains(at) && side.summary->at(at).is_array()) {
    for (const Json& interval : side.summary->at(at))
      if (is_of_motion(interval.at("why").get<std::string>()))
        doubts.push_back({interval.at("from_s").is_null() ? 0 : interval.at("from_s").get<double>(),
                          interval.at("until_s").is_null() ? kToTheEnd : interval.at("until_s").get<double>()});
  } else if (const auto until_s = side.number("/drift/reliable/until_s")) {  // of an older version
    doubts.push_back({*until_s, kToTheEnd});
  }
  std::erase_if(doubts, [&](const Doubted& doubt) { return !(doubt.from_s < end_s); });
  return united(std::move(doubts));
}

bool Trust::at(double t_s) const {
  return std::none_of(doubts.begin(), doubts.end(), [&](const Doubted& doubt) { return doubt.contains(t_s); });
}

std::optional<double> Trust::until_s() const {
  return doubts.empty() || doubts.back().until_s < kToTheEnd ? std::nullopt : std::optional(doubts.back().from_s);
}

Trust common_trust(const Comparand& reference, const Comparand& candidate, double end_s, double least) {
  const std::vector<Doubted> before = doubts_of(reference, end_s), now = doubts_of(candidate, end_s);
  std::vector<Doubted> both = before;
  both.insert(both.end(), now.begin(), now.end());
  Trust trust{united(std::move(both)), ""};
  const double together = trusted_s(trust.doubts, end_s);
  if (!(together >= least * std::max(trusted_s(before, end_s), trusted_s(now, end_s))))
    trust.fault = fmt::format("trusted {} in the reference, {} now", trusted_words(before, end_s), trusted_words(now, end_s));
  return trust;
}

}  // namespace earthtop::compare
