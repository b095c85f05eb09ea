// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <limits>
#include <string>
#include <variant>

#include "bindings.hpp"
#include "earthtop/closed_form/free_body.hpp"
#include "earthtop/closed_form/lagrange_top.hpp"
#include "earthtop/closed_form/mean_precession.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/frames/degrees.hpp"
#include "earthtop/frames/site.hpp"
#include "number_arrays.hpp"

namespace earthtop::python {
namespace {

// Numbers in a row as what they mean, and back ----------------------------------------------------------------------------

template <class T>
Vec3<T> vector_at(const T* x) {
  return {x[0], x[1], x[2]};
}
template <class T>
Quaternion<T> quaternion_at(const T* x) {
  return {x[0], vector_at(x + 1)};
}
template <class T>
SymmetricTop<T> top_at(const T* x) {
  return {x[0], x[1], x[2]};
}
template <class T>
void put(const Vec3<T>& v, T* y) {
  std::copy_n(v.data(), 3, y);
}
template <class T>
void put(const Quaternion<T>& q, T* y) {
  y[0] = q.w;
  put(q.v, y + 1);
}
template <class T>
void put(const ClosedFormState<T>& state, T* y) {
  put(state.q_NB, y);
  put(state.w_NB_B, y + 4);
  y[7] = state.attitude_error;
  y[8] = state.rate_error;
}
const Widths kStateWidths = {4, 3, 1, 1};

// Special cases -----------------------------------------------------------------------------------------------------------

/// A function of special_cases.hpp, or of the Earth, as Python calls it.
template <class T>
struct SpecialCase {
  std::string_view name;
  Widths arguments, results;
  void (*formula)(const T* x, T* y);
};

template <class T>
const std::vector<SpecialCase<T>>& special_cases() {
  static const std::vector<SpecialCase<T>> table = {
      {"steady_precession_rates",
       {1, 1, 1, 1, 1},
       {1, 1},
       [](const T* x, T* y) {
         const auto rates = steady_precession_rates<T>(top_at(x), x[3], x[4]);
         y[0] = rates ? rates->slow : std::numeric_limits<double>::quiet_NaN();
         y[1] = rates ? rates->fast : std::numeric_limits<double>::quiet_NaN();
       }},
      {"steady_precession",
       {4, 1, 1, 1},
       kStateWidths,
       [](const T* x, T* y) { put(steady_precession<T>(quaternion_at(x), x[4], x[5], x[6]), y); }},
      {"critical_spin", {1, 1, 1}, {1}, [](const T* x, T* y) { *y = critical_spin<T>(top_at(x)); }},
      {"upright_growth_rate", {1, 1, 1, 1}, {1}, [](const T* x, T* y) { *y = upright_growth_rate<T>(top_at(x), x[3]); }},
      {"homoclinic_top",
       {1, 1, 1, 1, 1},
       kStateWidths,
       [](const T* x, T* y) { put(homoclinic_top<T>(top_at(x), x[3], x[4]), y); }},
      {"separatrix_free_body",
       {3, 1, 1},
       kStateWidths,
       [](const T* x, T* y) { put(separatrix_free_body<T>(vector_at(x), x[3], x[4]), y); }},
      {"seen_from_laboratory",
       {4, 3, 1, 1, 3, 1},
       kStateWidths,
       [](const T* x, T* y) {
         const ClosedFormState<T> state{quaternion_at(x), vector_at(x + 4), x[7], x[8]};
         const LaboratoryState<T> seen = seen_from_laboratory<T>(state, vector_at(x + 9), x[12]);
         put(ClosedFormState<T>{seen.q_LB, seen.w_LB_B, seen.attitude_error, seen.rate_error}, y);
       }},
      {"balanced_gyroscope_axis_L",
       {3, 3, 1},
       {3},
       [](const T* x, T* y) { put(balanced_gyroscope_axis_L<T>(vector_at(x), vector_at(x + 3), x[6]), y); }},
      {"balanced_gyroscope_drift",
       {1, 1, 1},
       {1},
       [](const T* x, T* y) { *y = balanced_gyroscope_drift<T>(x[0], x[1], x[2]); }},
      {"sleeping_top_lean_south",
       {1, 1, 1, 1, 3},
       {1, 1},
       [](const T* x, T* y) {
         const FirstOrder<T> lean = sleeping_top_lean_south<T>(top_at(x), x[3], vector_at(x + 4));
         y[0] = lean.value;
         y[1] = lean.left_out;
       }},
      {"resting_axis_L",
       {1, 1, 1, 1, 3},
       {3},
       [](const T* x, T* y) { put(resting_axis_L<T>(top_at(x), x[3], vector_at(x + 4)), y); }},
      {"foucault_rate",
       {1, 1, 1, 1, 3},
       {1, 1},
       [](const T* x, T* y) {
         const FirstOrder<T> rate = foucault_rate<T>(top_at(x), x[3], vector_at(x + 4));
         y[0] = rate.value;
         y[1] = rate.left_out;
       }},
      {"earth_rate_L",
       {1, 1},
       {3},
       [](const T* x, T* y) {
         const SinCos<T> latitude = sin_cos_degrees<T>(x[0]);
         put(Vec3<T>(T(0), x[1] * latitude.cos, x[1] * latitude.sin), y);
       }},
  };
  return table;
}

py::tuple special_case(const std::string& name, const std::string& precision, const std::vector<py::array>& arguments,
                       const std::vector<py::ssize_t>& shape) {
  return in_precision(precision, [&]<class T>(std::type_identity<T>) {
    for (const SpecialCase<T>& one : special_cases<T>())
      if (one.name == name) return evaluate<T>(one.formula, one.arguments, arguments, one.results, shape);
    throw std::invalid_argument("no such closed form");
  });
}

/// The mean rates of a symmetric top, which there are in double precision only; NaN where it has none.
py::tuple mean_rates_of_tops(const std::vector<py::array>& arguments, const std::vector<py::ssize_t>& shape) {
  const auto formula = [](const double* x, double* y) {
    const auto rates = mean_rates(top_constants(top_at(x), quaternion_at(x + 3), vector_at(x + 7)));
    y[0] = rates ? rates->precession_rad_s : std::numeric_limits<double>::quiet_NaN();
    y[1] = rates ? rates->nutation_rad_s : std::numeric_limits<double>::quiet_NaN();
  };
  return evaluate<double>(formula, {1, 1, 1, 4, 3}, arguments, {1, 1}, shape);
}

// Whole motions -----------------------------------------------------------------------------------------------------------

std::string_view name_of(LagrangeRegime regime) {
  switch (regime) {
    case LagrangeRegime::at_rest: return "at_rest";
    case LagrangeRegime::free: return "free";
    case LagrangeRegime::sleeping: return "sleeping";
    case LagrangeRegime::homoclinic: return "homoclinic";
    case LagrangeRegime::steady: return "steady";
    case LagrangeRegime::wavy: return "wavy";
    case LagrangeRegime::cusped: return "cusped";
    case LagrangeRegime::looping: return "looping";
    case LagrangeRegime::plane_swinging: return "plane_swinging";
    case LagrangeRegime::plane_turning: return "plane_turning";
  }
  return "";
}

std::string_view name_of(FreeBodyRegime regime) {
  switch (regime) {
    case FreeBodyRegime::at_rest: return "at_rest";
    case FreeBodyRegime::spherical: return "spherical";
    case FreeBodyRegime::principal_axis: return "principal_axis";
    case FreeBodyRegime::symmetric: return "symmetric";
    case FreeBodyRegime::around_smallest: return "around_smallest";
    case FreeBodyRegime::around_largest: return "around_largest";
    case FreeBodyRegime::separatrix: return "separatrix";
  }
  return "";
}

/// A closed form in the precision that was asked for.
template <template <class> class Form>
struct InAnyPrecision {
  std::variant<Form<double>, Form<float80>, Form<float128>> form;

  template <class Use>
  auto visit(const Use& use) const {
    return std::visit([&]<class T>(const Form<T>& one) { return use(one); }, form);
  }
  py::tuple at(const py::array& t, const std::vector<py::ssize_t>& shape) const {
    return visit([&]<class T>(const Form<T>& one) {
      return evaluate<T>([&one](const T* x, T* y) { put(one.at(*x), y); }, {1}, {t}, kStateWidths, shape);
    });
  }
  std::string_view regime() const {
    return visit([](const auto& one) { return name_of(one.regime()); });
  }
};
using AnyLagrangeTop = InAnyPrecision<LagrangeTop>;
using AnyFreeBody = InAnyPrecision<FreeBody>;

AnyLagrangeTop lagrange_top(const std::string& precision, const py::array& numbers) {
  return in_precision(precision, [&]<class T>(std::type_identity<T>) {
    const std::vector<T> x = numbers_of<T>(numbers);
    if (x.size() != 10) throw std::invalid_argument("a top has 10 numbers");
    const DefaultArithmetic arithmetic;
    return AnyLagrangeTop{LagrangeTop<T>(top_at(x.data()), quaternion_at(x.data() + 3), vector_at(x.data() + 7))};
  });
}

/// @param numbers  3 moments or the 9 elements of a tensor, then quaternion and rate
AnyFreeBody free_body(const std::string& precision, const py::array& numbers) {
  return in_precision(precision, [&]<class T>(std::type_identity<T>) {
    const std::vector<T> x = numbers_of<T>(numbers);
    if (x.size() != 10 && x.size() != 16) throw std::invalid_argument("a free body has 10 or 16 numbers");
    const T* start = x.data() + x.size() - 7;
    const DefaultArithmetic arithmetic;
    if (x.size() == 10) return AnyFreeBody{FreeBody<T>(vector_at(x.data()), quaternion_at(start), vector_at(start + 4))};
    Mat3<T> inertia;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) inertia(i, j) = x[static_cast<std::size_t>(3 * i + j)];
    return AnyFreeBody{FreeBody<T>(inertia, quaternion_at(start), vector_at(start + 4))};
  });
}

template <class Any>
py::class_<Any> bind_motion(py::module_& module, const char* name, Any (*make)(const std::string&, const py::array&)) {
  return py::class_<Any>(module, name)
      .def(py::init(make), py::arg("precision"), py::arg("numbers"))
      .def("at", &Any::at, py::arg("t_s"), py::arg("shape"))
      .def_property_readonly("regime", &Any::regime);
}

}  // namespace

void bind_closed_form(py::module_& module) {
  module.attr("earth_rate_rad_s") = kEarthRateWgs84;
  module.def("special_case", &special_case, py::arg("name"), py::arg("precision"), py::arg("arguments"), py::arg("shape"));
  module.def("mean_rates", &mean_rates_of_tops, py::arg("arguments"), py::arg("shape"));
  bind_motion<AnyFreeBody>(module, "FreeBody", &free_body);
  bind_motion<AnyLagrangeTop>(module, "LagrangeTop", &lagrange_top)
      .def_property_readonly(
          "figures",
          [](const AnyLagrangeTop& top) {
            return top.visit([]<class T>(const LagrangeTop<T>& one) {
              const DefaultArithmetic arithmetic;
              return array_of_numbers<T>({one.nutation_period_s(), one.parameter(), one.complementary_parameter()});
            });
          },
          "period of the tilt (s), squared modulus and its complement");
}

}  // namespace earthtop::python
