// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/measures.ipp"

namespace earthtop {

template DriftPhases<double> drift_phases(const DriftState<double>&);
template DriftPhases<long double> drift_phases(const DriftState<long double>&);
template DriftPhases<float128> drift_phases(const DriftState<float128>&);
template DriftMeasures<double> measure_drift(const DriftState<double>&, DriftSought);
template DriftMeasures<long double> measure_drift(const DriftState<long double>&, DriftSought);
template DriftMeasures<float128> measure_drift(const DriftState<float128>&, DriftSought);

AzimuthSample azimuth_sample(const DriftState<double>& state) {
  const drift_measures::AxisPair<double> axes(state);
  AzimuthSample sample;
  sample.defined = axes.azimuth_defined;
  if (sample.defined) sample.drift_rad = drift_measures::angle_of(axes.azimuth_sine(), axes.azimuth_cosine());
  sample.ref_east = axes.n[0], sample.ref_north = axes.n[1];
  sample.horizontal = axes.horizontal_rot;
  return sample;
}

}  // namespace earthtop
