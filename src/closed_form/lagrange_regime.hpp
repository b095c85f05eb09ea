// SPDX-License-Identifier: GPL-3.0-or-later
/// Names the kind of motion of a symmetric top from the roots of its cubic.
#pragma once

#include "closed_form/lagrange_roots.hpp"
#include "earthtop/closed_form/lagrange_top.hpp"

namespace earthtop {

/// @param eps  relative rounding of the input; numbers count as equal if they differ by less than 16 eps times the terms that
/// they are a sum of
template <class W>
LagrangeRegime lagrange_regime(const NutationData<W>& d, const NutationRoots<W>& r, W eps) {
  const W near = W(16) * eps, twice = W(2) * d.mu;
  const auto size = [](W x) { return real::abs(x); };
  const W scale = d.P0 + twice + d.beta * d.beta;  // 1/s^2
  if (!(scale > W(0))) return LagrangeRegime::at_rest;
  if (twice > W(0) && d.top <= near * near && d.P0 <= near * near * scale) return LagrangeRegime::sleeping;
  if (!(r.P1 > near * near * scale)) return LagrangeRegime::at_rest;
  if (!(twice > W(0))) return LagrangeRegime::free;
  if (r.gap_terms * near >= r.gap && r.gap < r.span / W(2)) return LagrangeRegime::homoclinic;
  const W slope_terms = W(2) * (size(d.c0 * d.beta) + size(d.u0) * d.P0 + d.mu * d.top * d.bottom);
  if (r.width * r.span <= near * slope_terms) return LagrangeRegime::steady;
  const W plane = near * near * scale;
  if (r.at_top * r.at_top <= plane && r.at_bottom * r.at_bottom <= plane)
    return r.top_energy > W(0) ? LagrangeRegime::plane_turning : LagrangeRegime::plane_swinging;
  if (size(r.at_rest) <= near * (twice * size(d.c0) + size(d.beta) * d.P0)) return LagrangeRegime::cusped;
  const W c1 = d.c0 - d.beta * r.s1, c2 = d.c0 - d.beta * r.s2;
  return c1 * c2 < W(0) ? LagrangeRegime::looping : LagrangeRegime::wavy;
}

}  // namespace earthtop
