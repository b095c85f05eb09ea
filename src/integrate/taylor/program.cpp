// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/program.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <map>
#include <tuple>

#include "integrate/taylor/products.hpp"

namespace earthtop::taylor {
namespace {

bool uses_b(Kind kind) {
  return kind == Kind::product || kind == Kind::quotient || kind == Kind::cosine || kind == Kind::linear;
}
bool uses_a(Kind kind) { return kind >= Kind::held; }

}  // namespace

/// Turns the list of operations into runs of instructions.
template <class T>
class Program<T>::Builder {
 public:
  explicit Builder(const Operations<T>& operations) : list_(operations.list), source_(operations) {}

  void build(Program& program) {
    mark_needed();
    find_still();
    place(program);
    for (std::size_t i = 0; i < order_.size(); ++i) program.instructions_.push_back(instruction(order_[i], program));
    for (Guard guard : source_.guards)
      program.guards_.push_back({new_place_[index(guard.less)], new_place_[index(guard.more)], guard.outcome});
    for (const int output : source_.outputs) program.outputs_.push_back(new_place_[index(output)]);
  }

 private:
  static std::size_t index(int place) { return static_cast<std::size_t>(place); }
  template <class Use>
  void for_operands(const Operation<T>& o, Use use) const {
    if (uses_a(o.kind)) use(o.a);
    if (uses_b(o.kind) && o.b >= 0) use(o.b);
  }

  /// Finds the operations that the outputs need at all orders (late), those that only guards and held results need (early), and
  /// how often each is used.
  void mark_needed() {
    late_.assign(list_.size(), false), early_.assign(list_.size(), false), uses_.assign(list_.size(), 0);
    for (const int output : source_.outputs) late_[index(output)] = true, uses_[index(output)] += 2;
    for (const Guard& guard : source_.guards)
      for (const int place : {guard.less, guard.more}) early_[index(place)] = true, uses_[index(place)] += 2;
    for (std::size_t i = list_.size(); i-- > 0;) {
      if (!late_[i] && !early_[i]) continue;
      const Operation<T>& o = list_[i];
      // Sine and cosine are computed together.
      if (o.kind == Kind::sine) (late_[i] ? late_ : early_)[i + 1] = true;
      for_operands(o, [&](int operand) {
        (late_[i] && o.kind != Kind::held ? late_ : early_)[index(operand)] = true;
        // Sums are joined only within the same part of the work.
        uses_[index(operand)] += o.kind == Kind::linear && late_[i] == late_[index(operand)] ? 1 : 2;
      });
      if (o.kind == Kind::sine && late_[i + 1]) late_[i] = true;
    }
  }
  bool needed(std::size_t i) const { return late_[i] || early_[i]; }

  /// Finds results that have no order but 0, apart from functions of state and time.
  void find_still() {
    still_.assign(list_.size(), false);
    for (std::size_t i = 0; i < list_.size(); ++i) {
      const Operation<T>& o = list_[i];
      if (o.kind == Kind::constant || o.kind == Kind::held) {
        still_[i] = true;
      } else if (uses_a(o.kind)) {
        bool all = true;
        for_operands(o, [&](int operand) { all = all && still_[index(operand)]; });
        still_[i] = all;
      }
    }
  }

  /// The terms of a sum; sums that are used only once, in this one, are written out.
  void collect(int place, T factor, std::vector<Term>& terms, T& number) const {
    const Operation<T>& o = list_[index(place)];
    const auto add = [&](int operand, T f) {
      const Operation<T>& inner = list_[index(operand)];
      if (inner.kind == Kind::linear && is_joined(operand))
        collect(operand, f, terms, number);
      else if (inner.kind == Kind::constant)
        number += f * inner.number;
      else
        terms.push_back({operand, f});
    };
    number += factor * o.number;
    add(o.a, factor * o.factor_a);
    if (o.b >= 0) add(o.b, factor * o.factor_b);
  }
  bool is_joined(int place) const { return list_[index(place)].kind == Kind::linear && uses_[index(place)] == 1; }

  /// Brings the operations into runs: again and again, all operations of one kind whose operands are there. Sums and products
  /// take turns where they can, so that the runs are long.
  void place(Program& program) {
    sums_.resize(list_.size());
    std::vector<int> waiting;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (!needed(i) || is_joined(static_cast<int>(i))) continue;
      waiting.push_back(static_cast<int>(i));
      if (list_[i].kind != Kind::linear) continue;
      collect(static_cast<int>(i), T(1), sums_[i].terms, sums_[i].number);
      // Sums of one length make one run: lengths are filled up by terms of a factor 0.
      std::ranges::stable_sort(sums_[i].terms, std::greater{}, [](const Term& term) { return term.factor; });
      const std::size_t length = std::bit_ceil(sums_[i].terms.size());
      while (sums_[i].terms.size() < length) sums_[i].terms.push_back({sums_[i].terms.front().place, T(0)});
    }
    new_place_.assign(list_.size(), -1);
    while (!waiting.empty()) {
      std::map<Group, std::vector<int>> ready;
      for (const int place : waiting)
        if (is_ready(place)) ready[group_of(place)].push_back(place);
      const auto longest = std::ranges::max_element(ready, {}, [](const auto& entry) { return entry.second.size(); });
      for (const int place : longest->second) put(place);
      std::erase_if(waiting, [&](int place) { return new_place_[index(place)] >= 0; });
    }
    int lane = 0;
    lanes_.assign(list_.size(), -1);
    for (const int place : order_) {
      if (is_early(index(place)) || is_by_held(index(place)) || still_[index(place)]) continue;
      if (lanes_of(list_[index(place)].kind) == 0) continue;
      lanes_[index(place)] = lane;
      lane += lanes_of(list_[index(place)].kind);
    }
    program.lanes_ = lane;
  }
  void put(int place) {
    new_place_[index(place)] = static_cast<int>(order_.size());
    order_.push_back(place);
    // A cosine follows its sine.
    const int next = place + 1;
    if (list_[index(place)].kind == Kind::sine)
      new_place_[index(next)] = static_cast<int>(order_.size()), order_.push_back(next);
  }
  /// What the operations of a run have in common.
  using Group = std::tuple<bool, Kind, bool, std::size_t, bool>;
  Group group_of(int place) const {
    const std::size_t i = index(place);
    return {is_early(i), list_[i].kind, is_by_held(i), sums_[i].terms.size(), is_difference(sums_[i].terms)};
  }
  static bool is_difference(const std::vector<Term>& terms) {
    return terms.size() == 2 && terms[0].factor == T(1) && terms[1].factor == T(-1);
  }
  bool is_ready(int place) const {
    const Operation<T>& o = list_[index(place)];
    if (o.kind == Kind::cosine) return false;
    bool ready = true;
    const auto ask = [&](int operand) { ready = ready && new_place_[index(operand)] >= 0; };
    if (o.kind == Kind::linear) {
      for (const Term& term : sums_[index(place)].terms) ask(term.place);
    } else {
      for_operands(o, ask);
    }
    return ready;
  }
  bool is_early(std::size_t i) const { return !late_[i] || (still_[i] && list_[i].kind != Kind::constant); }
  bool is_by_held(std::size_t i) const {
    const Operation<T>& o = list_[i];
    if (o.kind == Kind::product) return still_[index(o.a)] != still_[index(o.b)];
    return o.kind == Kind::quotient && still_[index(o.b)] && !still_[index(o.a)];
  }

  Instruction instruction(int place, Program& program) {
    const std::size_t i = index(place);
    const Operation<T>& o = list_[i];
    Instruction made;
    made.kind = o.kind, made.early = is_early(i), made.by_held = is_by_held(i), made.number = o.number, made.lane = lanes_[i];
    made.a = o.a, made.b = o.b;
    if (uses_a(o.kind)) made.a = new_place_[index(o.a)];
    if (uses_b(o.kind) && o.b >= 0) made.b = new_place_[index(o.b)];
    if (o.kind == Kind::product && made.by_held && still_[index(o.b)])
      std::swap(made.a, made.b);  // the held factor comes first
    if (o.kind == Kind::linear) {
      made.first_term = static_cast<int>(program.terms_.size());
      made.terms = static_cast<int>(sums_[i].terms.size());
      made.number = sums_[i].number;
      for (const Term& term : sums_[i].terms) program.terms_.push_back({new_place_[index(term.place)], term.factor});
    }
    const bool plain = is_difference(sums_[i].terms);
    const auto goes_on = [&](const Run& run) {
      return run.kind == made.kind && run.early == made.early && run.by_held == made.by_held && run.terms == made.terms &&
             run.plain == plain;
    };
    if (program.runs_.empty() || !goes_on(program.runs_.back()))
      program.runs_.push_back({made.kind, made.early, made.by_held, new_place_[i], new_place_[i], made.terms, plain,
                               static_cast<int>(program.pairs_.size())});
    program.runs_.back().end = new_place_[i] + 1;
    if (o.kind == Kind::product) program.pairs_.push_back({made.a, made.b});
    if (plain)
      program.pairs_.push_back({new_place_[index(sums_[i].terms[0].place)], new_place_[index(sums_[i].terms[1].place)]});
    return made;
  }

  struct Sum {
    std::vector<Term> terms;
    T number = T(0);
  };
  const std::vector<Operation<T>>& list_;
  const Operations<T>& source_;
  std::vector<bool> late_, early_, still_;
  std::vector<int> uses_, order_, new_place_, lanes_;
  std::vector<Sum> sums_;
};

template <class T>
Program<T>::Program(const Operations<T>& operations) : given_(operations.given) {
  Builder(operations).build(*this);
  padded_ = (lanes_ + 7) / 8 * 8;
  const std::size_t size = static_cast<std::size_t>(padded_) * (kMostOrder<T> + 1);
  left_.assign(size, T(0)), right_.assign(size, T(0)), inner_.assign(static_cast<std::size_t>(padded_), T(0));
  now_.assign(instructions_.size(), T(0)), zero_ = now_;
  given_rows_.assign(given_.size(), std::vector<std::array<T, 3>>(kMostOrder<T> + 1));
}

template <class T>
void Program<T>::start(std::span<const T> x, T t) {
  for (std::size_t i = 0; i < given_.size(); ++i) given_[i].expand(t, given_rows_[i]);
  for (std::size_t i = 0; i < instructions_.size(); ++i) {
    const Instruction& in = instructions_[i];
    const auto at = [&](int place) { return zero_[static_cast<std::size_t>(place)]; };
    T& out = zero_[i];
    switch (in.kind) {
      case Kind::constant: out = in.number; break;
      case Kind::state: out = x[static_cast<std::size_t>(in.a)]; break;
      case Kind::time: out = t; break;
      case Kind::given: out = given_rows_[static_cast<std::size_t>(in.a)][0][static_cast<std::size_t>(in.b)]; break;
      case Kind::held: out = at(in.a); break;
      case Kind::linear: {
        T sum = in.number;
        for (int j = in.first_term; j < in.first_term + in.terms; ++j) {
          const Term& term = terms_[static_cast<std::size_t>(j)];
          sum += term.factor * at(term.place);
        }
        out = sum;
        break;
      }
      case Kind::product:
        out = at(in.a) * at(in.b);
        if (in.lane >= 0) left(0, in.lane) = at(in.a), right(0, in.lane) = at(in.b);
        break;
      case Kind::quotient:
        out = at(in.a) / at(in.b);
        if (in.lane >= 0) left(0, in.lane) = out, right(0, in.lane) = at(in.b);
        break;
      case Kind::square_root:
        out = real::sqrt(at(in.a));
        if (in.lane >= 0) left(0, in.lane) = right(0, in.lane) = out;
        break;
      case Kind::power:
        out = real::pow(at(in.a), in.number);
        if (in.lane >= 0) {
          left(0, in.lane) = T(0), right(0, in.lane) = out;
          left(0, in.lane + 1) = at(in.a), right(0, in.lane + 1) = T(0);
        }
        break;
      case Kind::sine: {
        const SinCos<T> both = real::sin_cos(at(in.a));
        out = both.sin;
        zero_[i + 1] = both.cos;
        if (in.lane >= 0) {
          left(0, in.lane) = left(0, in.lane + 1) = T(0);
          right(0, in.lane) = both.cos, right(0, in.lane + 1) = both.sin;
        }
        break;
      }
      case Kind::cosine: break;
    }
  }
}

template <class T>
bool Program<T>::guards_hold() const {
  return std::ranges::all_of(guards_, [&](const Guard& guard) {
    return (zero_[static_cast<std::size_t>(guard.less)] < zero_[static_cast<std::size_t>(guard.more)]) == guard.outcome;
  });
}

template <class T>
void Program<T>::run_order(int k, std::span<const T> x) {
  convolve_inner(left_.data(), right_.data(), k, padded_, inner_.data());
  T* now = now_.data();
  const T* zero = zero_.data();
  const T order = T(k);
  T* left_k = &left(k, 0);
  T* right_k = &right(k, 0);
  const T* left_0 = &left(0, 0);
  const T* right_0 = &right(0, 0);
  const T* inner = inner_.data();
  for (const Run& run : runs_) {
    if (run.early) continue;
    const Instruction* in = &instructions_[static_cast<std::size_t>(run.begin)];
    T* out = now + run.begin;
    const int count = run.end - run.begin;
    switch (run.kind) {
      case Kind::constant: break;  // 0, as set at the beginning
      case Kind::held: break;
      case Kind::state:
        for (int i = 0; i < count; ++i) out[i] = x[static_cast<std::size_t>(in[i].a)];
        break;
      case Kind::time:
        for (int i = 0; i < count; ++i) out[i] = k == 1 ? T(1) : T(0);
        break;
      case Kind::given:
        for (int i = 0; i < count; ++i)
          out[i] =
              given_rows_[static_cast<std::size_t>(in[i].a)][static_cast<std::size_t>(k)][static_cast<std::size_t>(in[i].b)];
        break;
      case Kind::linear: {
        const Term* term = terms_.data() + in[0].first_term;
        const Pair* pair = pairs_.data() + run.first_pair;
        if (run.plain) {
          for (int i = 0; i < count; ++i) out[i] = now[pair[i].a] - now[pair[i].b];
        } else if (run.terms == 1) {
          for (int i = 0; i < count; ++i, ++term) out[i] = term->factor * now[term->place];
        } else if (run.terms == 2) {
          for (int i = 0; i < count; ++i, term += 2)
            out[i] = term[0].factor * now[term[0].place] + term[1].factor * now[term[1].place];
        } else if (run.terms == 4) {
          for (int i = 0; i < count; ++i, term += 4)
            out[i] = (term[0].factor * now[term[0].place] + term[1].factor * now[term[1].place]) +
                     (term[2].factor * now[term[2].place] + term[3].factor * now[term[3].place]);
        } else {
          for (int i = 0; i < count; ++i) {
            T sum = T(0);
            for (int j = 0; j < run.terms; ++j, ++term) sum += term->factor * now[term->place];
            out[i] = sum;
          }
        }
        break;
      }
      case Kind::product:
        if (const Pair* pair = pairs_.data() + run.first_pair; run.by_held) {
          for (int i = 0; i < count; ++i) out[i] = zero[pair[i].a] * now[pair[i].b];
        } else {
          const int first = in[0].lane;
          for (int i = 0; i < count; ++i) {
            const T a = now[pair[i].a], b = now[pair[i].b];
            const int l = first + i;
            left_k[l] = a, right_k[l] = b;
            out[i] = inner[l] + (left_0[l] * b + a * right_0[l]);
          }
        }
        break;
      case Kind::quotient:
        if (run.by_held) {
          for (int i = 0; i < count; ++i) out[i] = now[in[i].a] / zero[in[i].b];
        } else {
          for (int i = 0; i < count; ++i) {
            const int l = in[i].lane;
            const T b = now[in[i].b];
            out[i] = (now[in[i].a] - (left_0[l] * b + inner[l])) / right_0[l];
            left_k[l] = out[i], right_k[l] = b;
          }
        }
        break;
      case Kind::square_root:
        for (int i = 0; i < count; ++i) {
          const int l = in[i].lane;
          out[i] = (now[in[i].a] - inner[l]) / (left_0[l] + left_0[l]);
          left_k[l] = right_k[l] = out[i];
        }
        break;
      case Kind::power:
        for (int i = 0; i < count; ++i) {
          const int l = in[i].lane;
          const T a = now[in[i].a];
          const T slope = inner[l] + order * a * right_0[l];
          out[i] = (in[i].number * slope - inner[l + 1]) / (order * left_0[l + 1]);
          left_k[l] = order * a, right_k[l] = out[i];
          left_k[l + 1] = a, right_k[l + 1] = order * out[i];
        }
        break;
      case Kind::sine:
        for (int i = 0; i < count; ++i) {
          const int l = in[i].lane;
          const T rate = order * now[in[i].a];
          const T sine = (inner[l] + rate * right_0[l]) / order, cosine = -(inner[l + 1] + rate * right_0[l + 1]) / order;
          out[i] = sine, now[run.begin + i + 1] = cosine;
          left_k[l] = left_k[l + 1] = rate;
          right_k[l] = cosine, right_k[l + 1] = sine;
        }
        break;
      case Kind::cosine: break;  // computed with the sine
    }
  }
}

template <class T>
void Program<T>::extend(int k, std::span<const T> x, std::span<T> rate) {
  if (k > 0) run_order(k, x);
  const std::vector<T>& found = k > 0 ? now_ : zero_;
  for (std::size_t i = 0; i < outputs_.size(); ++i) rate[i] = found[static_cast<std::size_t>(outputs_[i])];
}

template class Program<double>;
template class Program<long double>;
template class Program<float128>;

}  // namespace earthtop::taylor
