// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/measures.ipp"

namespace earthtop {

template DriftPhases<double> drift_phases(const DriftState<double>&);
template DriftPhases<float80> drift_phases(const DriftState<float80>&);
template DriftPhases<float128> drift_phases(const DriftState<float128>&);
template DriftMeasures<double> measure_drift(const DriftState<double>&, DriftSought);
template DriftMeasures<float80> measure_drift(const DriftState<float80>&, DriftSought);
template DriftMeasures<float128> measure_drift(const DriftState<float128>&, DriftSought);
template AxisDrift<double> drift_of_axis(const DriftState<double>&, const Vec3<double>&);
template AxisDrift<float80> drift_of_axis(const DriftState<float80>&, const Vec3<float80>&);
template AxisDrift<float128> drift_of_axis(const DriftState<float128>&, const Vec3<float128>&);

AzimuthSample azimuth_sample(const DriftSample<double>& sample) {
  const drift_measures::AxisPair<double> axes(sample.state);
  return {sample.measures.azimuth_defined, sample.azimuth, axes.n[0], axes.n[1], axes.horizontal_rot};
}

}  // namespace earthtop
