// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/record_motion.ipp"

namespace earthtop {
template taylor::Operations<double> record_motion(const Model<double>&, std::span<const double>, double);
}  // namespace earthtop
