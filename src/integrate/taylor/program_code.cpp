// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/program_code.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <span>

#include "integrate/taylor/program_sums.hpp"

namespace earthtop::taylor {
namespace {

template <class T>
class Builder : ProgramSums<T> {
 public:
  using ProgramSums<T>::ProgramSums;

  ProgramCode<T> build() {
    place_sources();
    put_steps();
    place_lanes_of_others();
    code_.places = rounded_up(next_place_), code_.lanes = (next_lane_ + 7) / 8 * 8;
    write_start();
    for (const Guard& guard : source_.guards)
      code_.guards.push_back({places_[index(guard.less)], places_[index(guard.more)], guard.outcome});
    put_outputs();
    return std::move(code_);
  }

 private:
  using Sums = ProgramSums<T>;
  using Sums::index, Sums::for_operands, Sums::is_late, Sums::is_needed, Sums::is_sum, Sums::is_joined, Sums::length, Sums::one;
  using Sums::list_, Sums::source_, Sums::still_, Sums::sums_;
  using typename Sums::Term;
  using Instruction = typename ProgramCode<T>::Instruction;
  static constexpr int kPack = ProgramCode<T>::kPack;
  static int rounded_up(int count) { return (count + kPack - 1) / kPack * kPack; }
  void place_sources() {
    places_.assign(list_.size(), -1);
    // Zeros fill up the last pack of the state.
    zero_place_ = code_.components = static_cast<int>(source_.outputs.size());
    next_place_ = rounded_up(zero_place_ + 1);
    for (int i = 0; i < static_cast<int>(list_.size()); ++i) {
      const Operation<T>& o = list_[index(i)];
      if (!is_needed(i)) continue;
      if (o.kind == Kind::state) {
        places_[index(i)] = o.a;
      } else if (!is_late(i) || o.kind == Kind::time || o.kind == Kind::given) {
        if (!is_joined(i)) places_[index(i)] = next_place_++;
      }
      if (o.kind == Kind::time) code_.time = places_[index(i)];
      if (o.kind == Kind::given) code_.given.push_back({places_[index(i)], o.a, o.b});
    }
    // Those of single instructions are between the others and the packs; a cosine follows its sine.
    singles_place_ = next_place_;
    for (int i = 0; i < static_cast<int>(list_.size()); ++i)
      if (is_needed(i) && is_late(i) && !is_sum(i) && lanes_of(list_[index(i)].kind) > 0 &&
          list_[index(i)].kind != Kind::product)
        next_place_ += list_[index(i)].kind == Kind::sine ? 2 : 1;
    code_.first_result = next_place_ = rounded_up(next_place_);
  }
  std::vector<int> late_operations() const {
    std::vector<int> late;
    for (int i = 0; i < static_cast<int>(list_.size()); ++i)
      if (is_late(i) && places_[index(i)] < 0 && !is_joined(i) && list_[index(i)].kind != Kind::cosine) late.push_back(i);
    return late;
  }
  /// Calls `use` for the operands that an operation has at each order.
  template <class Use>
  void for_late_operands(int i, Use use) const {
    if (is_sum(i)) {
      for (const Term& term : sums_[index(i)].terms) use(term.operand);
    } else {
      for_operands(list_[index(i)], use);
    }
  }
  bool is_ready(int i) const {
    bool ready = true;
    for_late_operands(i, [&](int operand) { ready = ready && places_[index(operand)] >= 0; });
    return ready;
  }

  /// Sums and products take turns. In each turn all that are ready are put, apart from some that fill no pack and that can wait
  /// for the next turn without making the program longer.
  void put_steps() {
    std::vector<int> waiting = late_operations();
    find_distances(waiting);
    // Whether sums or products begin makes a difference of one turn.
    int longest = 0, first_kind = 0;
    for (const int i : waiting)
      if (distances_[index(i)] > longest) longest = distances_[index(i)], first_kind = kind_group(i);
    bool sums_turn = first_kind == kSums;
    for (int turns_left = longest; !waiting.empty(); --turns_left, sums_turn = !sums_turn) {
      const int group = sums_turn ? kSums : kProducts;
      put_ready_others(waiting);
      for (bool is_last = false; !is_last;) {
        std::vector<int> ready = ready_of(waiting, group);
        std::ranges::stable_sort(ready, std::greater{}, [&](int i) { return distances_[index(i)]; });
        const std::size_t full = ready.size() / kPack * kPack;
        if (full < ready.size() && distances_[index(ready[full])] + 2 <= turns_left) ready.resize(full);
        is_last = ready.empty();
        if (is_last) break;
        std::ranges::sort(ready);
        if (sums_turn)
          put_sums(ready);
        else
          put_products(ready);
        std::erase_if(waiting, [&](int i) { return places_[index(i)] >= 0; });
        put_ready_others(waiting);
      }
    }
  }
  enum Group { kSums, kProducts, kOthers };
  Group kind_group(int i) const { return is_sum(i) ? kSums : list_[index(i)].kind == Kind::product ? kProducts : kOthers; }
  std::vector<int> ready_of(const std::vector<int>& waiting, int group) const {
    std::vector<int> ready;
    for (const int i : waiting)
      if (kind_group(i) == group && is_ready(i)) ready.push_back(i);
    return ready;
  }
  void put_ready_others(std::vector<int>& waiting) {
    for (std::vector<int> others; !(others = ready_of(waiting, kOthers)).empty();) {
      put_others(others);
      std::erase_if(waiting, [&](int i) { return places_[index(i)] >= 0; });
    }
  }
  /// Finds how many turns have to follow the one of each operation.
  void find_distances(const std::vector<int>& late) {
    distances_.assign(list_.size(), 0);
    for (auto i = late.rbegin(); i != late.rend(); ++i)
      for_late_operands(*i, [&](int operand) {
        // A cosine is put with its sine.
        if (list_[index(operand)].kind == Kind::cosine) --operand;
        const Group group = kind_group(*i);
        const int turns = group == kOthers || group == kind_group(operand) ? 0 : 1;
        distances_[index(operand)] = std::max(distances_[index(operand)], distances_[index(*i)] + turns);
      });
  }
  void put_products(const std::vector<int>& products) {
    lanes_.resize(list_.size(), -1);
    for (std::size_t begin = 0; begin < products.size(); begin += kPack) {
      const std::size_t end = std::min(begin + kPack, products.size());
      code_.steps.push_back(ProgramCode<T>::kProducts);
      for (const auto side : {&Operation<T>::a, &Operation<T>::b})
        for (std::size_t j = begin; j < begin + kPack; ++j)
          code_.operands.push_back(operand(j < end ? places_[index(list_[index(products[j])].*side)] : zero_place_));
      for (std::size_t j = begin; j < end; ++j) {
        places_[index(products[j])] = next_place_ + static_cast<int>(j - begin);
        lanes_[index(products[j])] = next_lane_ + static_cast<int>(j - begin);
      }
      next_place_ += kPack, next_lane_ += kPack;
    }
    code_.products += static_cast<int>(products.size());
  }
  /// Puts sums in the order of their lengths; shorter ones of the same pack are filled up.
  void put_sums(std::vector<int>& sums) {
    std::ranges::stable_sort(sums, std::greater{}, [&](int i) { return length(i); });
    for (std::size_t begin = 0; begin < sums.size(); begin += kPack) {
      const std::size_t count = std::min<std::size_t>(kPack, sums.size() - begin);
      put_pack_of_sums({sums.data() + begin, count});
    }
  }
  void put_pack_of_sums(std::span<const int> sums) {
    const int terms = length(sums[0]);
    const int slot = static_cast<int>(code_.factors.size());
    code_.steps.push_back(ProgramCode<T>::kSums + terms);
    const auto size = index(slot + terms * kPack);
    code_.factors.resize(size, T(0)), code_.operands.resize(code_.operands.size() + size - index(slot), operand(zero_place_));
    std::uint32_t* const operands = code_.operands.data() + code_.operands.size() - (size - index(slot));
    for (std::size_t j = 0; j < sums.size(); ++j) {
      std::size_t at = j;
      for (Term& term : sums_[index(sums[j])].terms) {
        if (still_[index(term.operand)]) continue;
        operands[at] = operand(places_[index(term.operand)]);
        term.slot = slot + static_cast<int>(at);
        code_.factors[index(term.slot)] = term.factor;
        at += kPack;
      }
      places_[index(sums[j])] = next_place_ + static_cast<int>(j);
    }
    next_place_ += kPack;
  }
  static std::uint32_t operand(int place) { return static_cast<std::uint32_t>(place); }
  void put_others(const std::vector<int>& others) {
    for (const int i : others) {
      places_[index(i)] = singles_place_++;
      if (list_[index(i)].kind == Kind::sine) places_[index(i + 1)] = singles_place_++;
      code_.steps.push_back(ProgramCode<T>::kInstruction);
      others_.push_back(i);
    }
  }
  /// The lanes of single instructions follow those of the packs.
  void place_lanes_of_others() {
    code_.steps.push_back(ProgramCode<T>::kEnd);
    lanes_.resize(list_.size(), -1);
    for (const int i : others_) {
      lanes_[index(i)] = next_lane_;
      next_lane_ += lanes_of(list_[index(i)].kind), code_.products += lanes_of(list_[index(i)].kind);
      code_.instructions.push_back(instruction(i));
    }
  }
  void put_outputs() {
    code_.first_output = static_cast<int>(code_.operands.size());
    for (int i = 0; i < rounded_up(code_.components); ++i)
      code_.operands.push_back(operand(i < code_.components ? places_[index(source_.outputs[index(i)])] : zero_place_));
  }
  Instruction instruction(int i) const {
    const Operation<T>& o = list_[index(i)];
    Instruction made{.kind = o.kind, .out = places_[index(i)], .a = o.a, .b = o.b, .number = o.number};
    if (has_operand(o.kind)) made.a = places_[index(o.a)];
    if (uses_b(o.kind) && o.b >= 0) made.b = places_[index(o.b)];
    if (index(i) < lanes_.size()) made.lane = lanes_[index(i)];
    return made;
  }

  /// Lists what is carried out at the beginning of a step; as much as possible of one kind, one after the other.
  void write_start() {
    code_.factors.push_back(T(0));  // for factors that no other order needs
    std::vector<int> waiting;
    is_written_.assign(list_.size(), false);
    sums_.resize(list_.size());
    for (int i = 0; i < static_cast<int>(list_.size()); ++i) {
      const Operation<T>& o = list_[index(i)];
      if (!is_needed(i) || is_joined(i)) continue;
      ++code_.used;
      const bool is_there = is_number(o.kind) || o.kind == Kind::state;
      if (is_number(o.kind)) code_.constants.push_back({places_[index(i)], o.number});
      is_written_[index(i)] = is_there;
      if (!is_there) waiting.push_back(i);
    }
    while (!waiting.empty()) {
      std::map<Kind, std::vector<int>> ready;
      for (const int i : waiting)
        if (is_ready_at_start(i)) ready[start_kind(i)].push_back(i);
      const auto longest = std::ranges::max_element(ready, {}, [](const auto& entry) { return entry.second.size(); });
      const int begin = static_cast<int>(code_.at_start.size());
      for (const int i : longest->second) write_start_of(i), is_written_[index(i)] = true;
      code_.start_runs.push_back({longest->first, begin, static_cast<int>(code_.at_start.size())});
      std::erase_if(waiting, [&](int i) { return is_written_[index(i)]; });
    }
  }
  Kind start_kind(int i) const { return is_sum(i) ? Kind::linear : list_[index(i)].kind; }
  bool is_ready_at_start(int i) const {
    bool ready = true;
    const auto ask = [&](int operand) { ready = ready && is_written_[index(operand)]; };
    for (const Term& term : sums_[index(i)].terms) {
      ask(term.operand);
      if (term.held >= 0) ask(term.held);
    }
    if (start_kind(i) != Kind::linear) for_operands(list_[index(i)], ask);
    return ready;
  }
  void write_start_of(int i) {
    Instruction made = instruction(i);
    made.kind = start_kind(i);
    if (made.kind == Kind::linear) {
      const int no_slot = static_cast<int>(code_.factors.size()) - 1;
      made.first_term = static_cast<int>(code_.start_terms.size());
      made.terms = static_cast<int>(sums_[index(i)].terms.size());
      made.number = sums_[index(i)].number;
      made.holds = std::ranges::any_of(sums_[index(i)].terms, [](const Term& term) { return term.held >= 0; });
      for (const Term& term : sums_[index(i)].terms)
        code_.start_terms.push_back({places_[index(term.operand)], term.factor,
                                     places_[index(term.held < 0 ? one() : term.held)], term.slot < 0 ? no_slot : term.slot});
    }
    code_.at_start.push_back(made);
  }

  ProgramCode<T> code_;
  std::vector<bool> is_written_;
  std::vector<int> places_, lanes_, distances_, others_;
  int zero_place_ = -1, singles_place_ = 0, next_place_ = 0, next_lane_ = 0;
};

}  // namespace

template <class T>
ProgramCode<T> program_code(const Operations<T>& operations) {
  return Builder<T>(operations).build();
}
template ProgramCode<double> program_code(const Operations<double>&);
template ProgramCode<float80> program_code(const Operations<float80>&);
template ProgramCode<float128> program_code(const Operations<float128>&);

}  // namespace earthtop::taylor
