// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/products.hpp"

#include "integrate/taylor/for_each_processor.hpp"

namespace earthtop::taylor {

EARTHTOP_FOR_EACH_PROCESSOR void convolve_inner(const double* left, const double* right, int order, int lanes, double* sum) {
  int begin = 0;
  for (; lanes - begin >= 24; begin += 24) convolve_lanes<24>(left + begin, right + begin, order, lanes, sum + begin);
  if (lanes - begin == 16) return convolve_lanes<16>(left + begin, right + begin, order, lanes, sum + begin);
  if (lanes - begin == 8) convolve_lanes<8>(left + begin, right + begin, order, lanes, sum + begin);
}

}  // namespace earthtop::taylor
