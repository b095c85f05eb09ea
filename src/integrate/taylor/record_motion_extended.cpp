// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/record_motion.ipp"

namespace earthtop {
template taylor::Operations<float80> record_motion(const Model<float80>&, std::span<const float80>, float80);
template taylor::Operations<float128> record_motion(const Model<float128>&, std::span<const float128>, float128);
}  // namespace earthtop
