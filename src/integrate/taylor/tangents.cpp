// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/tangents.hpp"

#include <stdexcept>

#include "integrate/taylor/recorded.hpp"

namespace earthtop::taylor {
namespace {

/// Writes down a list again, with tangents.
template <class T>
class Tangents {
 public:
  using R = real::Recorded<T>;

  Tangents(const Operations<T>& source, std::size_t directions, std::span<const T> by_parameter, std::span<const T> x, T t)
      : source_(source),
        directions_(directions),
        slots_(x.size() / source.outputs.size() - 1),
        by_parameter_(by_parameter),
        x_(x),
        t_(t) {}

  Operations<T> write() {
    results_.resize(source_.list.size());
    for (std::size_t i = 0; i < results_.size(); ++i) results_[i] = result_of(source_.list[i]);
    // Comparisons of numbers are decided for good.
    for (const Guard& guard : source_.guards)
      if ((at(guard.less).value < at(guard.more).value) != guard.outcome)
        throw std::logic_error("tangents: the list was recorded on another branch");
    std::vector<int> outputs;
    for (const int output : source_.outputs) outputs.push_back(at(output).value.place_in(recording_));
    for (std::size_t k = 0; k < directions_; ++k)
      for (const int output : source_.outputs) outputs.push_back(at(output).tangents[k].place_in(recording_));
    while (outputs.size() < x_.size()) outputs.push_back(R().place_in(recording_));
    return recording_.finish(outputs);
  }

 private:
  struct Result {
    R value;
    std::vector<R> tangents;
  };
  const Result& at(int place) const { return results_[static_cast<std::size_t>(place)]; }

  R state(std::size_t component) {
    return R(recording_, recording_.add({.kind = Kind::state, .a = static_cast<int>(component)}, x_[component]));
  }
  R given(const Operation<T>& o) {
    // All components of a function are written down with its first one.
    const auto function = static_cast<std::size_t>(o.a);
    if (given_.size() <= function) given_.resize(function + 1, {-1, -1, -1});
    if (given_[function][0] < 0) given_[function] = recording_.given(source_.given[function], t_);
    return R(recording_, given_[function][static_cast<std::size_t>(o.b)]);
  }
  R linear(const Operation<T>& o, const R& a, const R& b, const R& number) const {
    return R(o.factor_a) * a + R(o.factor_b) * b + number;
  }

  /// Whether a number whose root is sought is zero, as the square of a rate at rest is: friction multiplies that root with the rate
  /// itself, so that its tangent, which does not exist, has no part in those of the motion. The list holds as long as the number is zero.
  bool rests(const R& number) const { return number.value() == T(0) && !(R() < number); }

  Result result_of(const Operation<T>& o) {
    using real::conserved, real::cos, real::pow, real::sin, real::sqrt;
    Result made{{}, std::vector<R>(directions_)};
    const auto each = [&](const auto& tangent) {
      for (std::size_t k = 0; k < directions_; ++k) made.tangents[k] = tangent(k);
    };
    const Result none{{}, std::vector<R>(directions_)};
    const Result& a = has_operand(o.kind) ? at(o.a) : none;
    const Result& b = has_operand(o.kind) && o.b >= 0 && o.kind != Kind::cosine ? at(o.b) : none;
    switch (o.kind) {
      case Kind::constant: made.value = o.number; break;
      case Kind::parameter:
        made.value = o.number;
        each([&](std::size_t k) { return R(by_parameter_[static_cast<std::size_t>(o.a) * slots_ + k]); });
        break;
      case Kind::state: {
        const auto component = static_cast<std::size_t>(o.a), size = source_.outputs.size();
        made.value = state(component);
        each([&](std::size_t k) { return state((k + 1) * size + component); });
        break;
      }
      case Kind::time: made.value = R(recording_, recording_.add({.kind = Kind::time}, t_)); break;
      case Kind::given: made.value = given(o); break;
      case Kind::held:
        made.value = conserved(a.value);
        each([&](std::size_t k) { return conserved(a.tangents[k]); });
        break;
      case Kind::linear:
        made.value = linear(o, a.value, b.value, R(o.number));
        each([&](std::size_t k) { return linear(o, a.tangents[k], b.tangents[k], R()); });
        break;
      case Kind::product:
        made.value = a.value * b.value;
        each([&](std::size_t k) { return a.tangents[k] * b.value + a.value * b.tangents[k]; });
        break;
      case Kind::quotient:
        made.value = a.value / b.value;
        each([&](std::size_t k) { return (a.tangents[k] - made.value * b.tangents[k]) / b.value; });
        break;
      case Kind::square_root:
        made.value = sqrt(a.value);
        if (!rests(a.value)) each([&](std::size_t k) { return a.tangents[k] / (R(2) * made.value); });
        break;
      case Kind::power:
        made.value = pow(a.value, R(o.number));
        if (!rests(a.value)) each([&](std::size_t k) { return R(o.number) * made.value * a.tangents[k] / a.value; });
        break;
      case Kind::sine:
        made.value = sin(a.value);
        each([&](std::size_t k) { return cos(a.value) * a.tangents[k]; });
        break;
      case Kind::cosine:
        made.value = cos(a.value);
        each([&](std::size_t k) { return -(sin(a.value) * a.tangents[k]); });
        break;
    }
    return made;
  }

  const Operations<T>& source_;
  std::size_t directions_, slots_;
  std::span<const T> by_parameter_, x_;
  T t_;
  Recording<T> recording_;
  std::vector<Result> results_;
  std::vector<std::array<int, 3>> given_;
};

}  // namespace

template <class T>
Operations<T> with_tangents(const Operations<T>& operations, std::size_t directions, std::span<const T> by_parameter,
                            std::span<const T> x, T t) {
  return Tangents<T>(operations, directions, by_parameter, x, t).write();
}
template Operations<double> with_tangents(const Operations<double>&, std::size_t, std::span<const double>,
                                          std::span<const double>, double);
template Operations<float80> with_tangents(const Operations<float80>&, std::size_t, std::span<const float80>,
                                           std::span<const float80>, float80);
template Operations<float128> with_tangents(const Operations<float128>&, std::size_t, std::span<const float128>,
                                            std::span<const float128>, float128);

}  // namespace earthtop::taylor
