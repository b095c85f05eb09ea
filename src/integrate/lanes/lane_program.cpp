// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/lanes/lane_program.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "earthtop/elementary.hpp"
#include "earthtop/real.hpp"

namespace earthtop::lanes {
namespace {

using Code = taylor::ProgramCode<double>;
using taylor::Kind;

int lane_kind(Kind kind) {
  switch (kind) {
    case Kind::time: return kTime;
    case Kind::given: return kGiven;
    case Kind::held: return kHeld;
    case Kind::product: return kProduct;
    case Kind::quotient: return kQuotient;
    case Kind::square_root: return kSquareRoot;
    case Kind::power: return kPower;
    case Kind::sine: return kSine;
    case Kind::cosine: return kWithSine;
    default: return kLinear;
  }
}
auto shape(const Code::Instruction& in) {
  return std::tuple(in.kind, in.out, in.a, in.b, in.lane, in.first_term, in.terms, in.holds);
}
auto shape(const Code::Term& term) { return std::tuple(term.place, term.held, term.slot); }
auto shape(const Code::StartRun& run) { return std::tuple(run.kind, run.begin, run.end); }
auto shape(const Code::Constant& constant) { return constant.out; }
auto shape(const Code::GivenComponent& given) { return std::tuple(given.out, given.function, given.component); }
auto shape(const taylor::Guard& guard) { return std::tuple(guard.less, guard.more, guard.outcome); }

template <class Item>
bool same(const std::vector<Item>& a, const std::vector<Item>& b) {
  return std::ranges::equal(
      a, b, {}, [](const Item& item) { return shape(item); }, [](const Item& item) { return shape(item); });
}

}  // namespace

bool have_same_code(const RecordedCode& first, const RecordedCode& second) {
  const Code &a = first.code, &b = second.code;
  return std::tie(a.steps, a.operands, a.first_result, a.first_output, a.components, a.time, a.places, a.lanes) ==
             std::tie(b.steps, b.operands, b.first_result, b.first_output, b.components, b.time, b.places, b.lanes) &&
         a.factors.size() == b.factors.size() && first.given.size() == second.given.size() && same(a.constants, b.constants) &&
         same(a.at_start, b.at_start) && same(a.start_runs, b.start_runs) && same(a.start_terms, b.start_terms) &&
         same(a.instructions, b.instructions) && same(a.given, b.given) && same(a.guards, b.guards);
}

LaneProgram::LaneProgram(const RecordedCode& first, int width) : code_(first.code), width_(static_cast<std::size_t>(width)) {
  const auto made = [&](const Code::Instruction& in, Kind kind) {
    LaneInstruction instruction{lane_kind(kind), in.out, in.a, in.b, in.lane, in.first_term, in.terms, in.holds ? 1 : 0};
    if (kind == Kind::given) instruction.a = first_given_row_[static_cast<std::size_t>(in.a)] + in.b * (kMostOrder + 1);
    return instruction;
  };
  int given_rows = 0;
  for (const auto& function : first.given) {
    first_given_row_.push_back(given_rows);
    given_rows += function.components * (kMostOrder + 1);
  }
  for (const Code::StartRun& run : code_.start_runs)
    for (int i = run.begin; i < run.end; ++i) starts_.push_back(made(code_.at_start[static_cast<std::size_t>(i)], run.kind));
  for (const Code::Instruction& in : code_.instructions) instructions_.push_back(made(in, in.kind));
  for (const Code::Term& term : code_.start_terms) terms_.push_back({term.place, term.held, term.slot});
  for (const Code::GivenComponent& given : code_.given)
    given_.push_back(
        {given.out, first_given_row_[static_cast<std::size_t>(given.function)] + given.component * (kMostOrder + 1)});
  for (const taylor::Guard& guard : code_.guards) guards_.push_back({guard.less, guard.more, guard.outcome ? 1 : 0});

  const auto sized = [](Doubles& numbers, std::size_t of_a_lane) { numbers.assign(of_a_lane * kLanes, 0.0); };
  find_slots();
  sized(zero_, static_cast<std::size_t>(code_.places)), sized(present_, static_cast<std::size_t>(code_.places));
  sized(factors_, code_.factors.size());
  sized(history_, static_cast<std::size_t>(read_.slots) * (kMostOrder + 1));
  sized(sums_, static_cast<std::size_t>(code_.lanes) * 2);
  numbers_.starts.assign(starts_.size(), Row{}), numbers_.start_factors.assign(terms_.size(), Row{});
  numbers_.instructions.assign(instructions_.size(), Row{});
  numbers_.given.assign(static_cast<std::size_t>(given_rows), Row{});
  expanded_.assign(kMostOrder + 1, {});

  read_.at_start = starts_.data(), read_.starts = static_cast<int>(starts_.size());
  read_.start_terms = terms_.data();
  read_.steps = code_.steps.data(), read_.operands = code_.operands.data();
  read_.instructions = instructions_.data();
  read_.given = given_.data(), read_.givens = static_cast<int>(given_.size());
  read_.guards = guards_.data(), read_.guard_count = static_cast<int>(guards_.size());
  read_.first_result = code_.first_result, read_.first_output = code_.first_output, read_.time = code_.time;
  read_.start_numbers = numbers_.starts.data(), read_.start_factors = numbers_.start_factors.data();
  read_.instruction_numbers = numbers_.instructions.data(), read_.given_rows = numbers_.given.data();
  read_.places = code_.places, read_.factor_count = static_cast<int>(code_.factors.size()),
  read_.packs = code_.lanes / Code::kPack;
  read_.zero = zero_.data(), read_.present = present_.data();
  read_.factors = factors_.data(), read_.history = history_.data(), read_.sums = sums_.data();
  read_.sin_cos = [](double x, double* sine, double* cosine) {
    const SinCos<double> both = real::sin_cos(x);
    *sine = both.sin, *cosine = both.cos;
  };
  read_.power = [](double x, double exponent) { return real::pow(x, exponent); };
  read_.square_root = [](double x) { return std::sqrt(x); };
}

/// Gives slots to the results that are factors of products, and to the factors of other operations.
void LaneProgram::find_slots() {
  constexpr int kPack = Code::kPack;
  std::map<unsigned, int> of_place;
  const auto slot_of = [&](unsigned place) {
    const auto [found, is_new] = of_place.try_emplace(place, static_cast<int>(slot_places_.size()));
    if (is_new) slot_places_.push_back(static_cast<int>(place));
    return found->second;
  };
  const unsigned* operands = code_.operands.data();
  for (const int step : code_.steps) {
    if (step == Code::kProducts)
      for (int i = 0; i < 2 * kPack; ++i) product_slots_.push_back(slot_of(operands[i]));
    operands += step == Code::kProducts ? 2 * kPack : step >= Code::kSums ? (step - Code::kSums) * kPack : 0;
  }
  read_.result_slots = read_.slots = static_cast<int>(slot_places_.size());
  for (std::size_t of_others = product_slots_.size(); of_others < 2 * static_cast<std::size_t>(code_.lanes); ++of_others)
    product_slots_.push_back(read_.slots++);
  read_.slot_places = slot_places_.data(), read_.product_slots = product_slots_.data();
}

void LaneProgram::put(std::size_t lane, const RecordedCode& point) {
  points_[lane] = &point;
  const Code& code = point.code;
  const auto places = static_cast<std::size_t>(code.places);
  for (std::size_t place = 0; place < places; ++place) at(zero_, places, place, lane) = 0.0;
  for (const Code::Constant& constant : code.constants)
    at(zero_, places, static_cast<std::size_t>(constant.out), lane) = constant.number;
  std::size_t next = 0;
  for (const Code::StartRun& run : code.start_runs)
    for (int i = run.begin; i < run.end; ++i)
      numbers_.starts[next++].lane[lane] = code.at_start[static_cast<std::size_t>(i)].number;
  for (std::size_t i = 0; i < terms_.size(); ++i) numbers_.start_factors[i].lane[lane] = code.start_terms[i].factor;
  for (std::size_t i = 0; i < instructions_.size(); ++i) numbers_.instructions[i].lane[lane] = code.instructions[i].number;
  for (std::size_t i = 0; i < code.factors.size(); ++i) at(factors_, code.factors.size(), i, lane) = code.factors[i];
}

void LaneProgram::set_time(std::size_t lane, double t) {
  read_.now.lane[lane] = t;
  const std::vector<taylor::GivenFunction<double>>& given = points_[lane]->given;
  for (std::size_t f = 0; f < given.size(); ++f) {
    given[f].expand(t, expanded_);
    Row* rows = numbers_.given.data() + first_given_row_[f];
    for (std::size_t component = 0; component < static_cast<std::size_t>(given[f].components); ++component)
      for (const std::array<double, 3>& order : expanded_) (rows++)->lane[lane] = order[component];
  }
}

}  // namespace earthtop::lanes
