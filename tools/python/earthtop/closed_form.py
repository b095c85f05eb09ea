# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions that have closed forms, for arrays of times and parameters.

>>> import numpy as np
>>> from earthtop.closed_form import LagrangeTop
>>> top = LagrangeTop(I1=1.2e-4, I3=4e-5, mgl=0.0294, q0=[1, 0.2, 0, 0], w0=[0, 0, 200])
>>> motion = top.at(np.linspace(0, 1, 1001))
>>> motion.q_NB.shape, motion.w_NB_B_rad_s.shape, motion.attitude_error_rad.shape
((1001, 4), (1001, 3), (1001,))
>>> top.regime
'cusped'

``LagrangeTop`` and ``FreeBody`` give the whole motion of a heavy symmetric top and of a free rigid body. The functions are
special cases, and what follows for gyroscopes, sleeping tops and pendulums on the rotating Earth.

N are inertial axes that coincide with the laboratory's (East, North, Up) at t = 0, B are the body's; gravity acts along -Up.
Of a symmetric top, body axis 3 is the axis of symmetry and carries the centre of mass. Its parameters are ``I1`` and ``I3``,
the moments about the pivot across and along that axis (kg m^2), and ``mgl``, mass times apparent gravity times the signed
distance of the centre of mass from the pivot (N m). Quaternions are (w, x, y, z); those that are given may have any norm but
zero.

Arguments are numbers, lists or arrays. Of functions they are broadcast against one another, as NumPy does; a vector or a
quaternion is the last axis. Results have the shape of the elements, and one more axis if they are vectors.

``precision`` is ``"double"``, ``"long_double"`` or ``"float128"``. In the last two, arguments may also be decimal text, or
numbers of mpmath, decimal or fractions; each is rounded once, from its exact value to the nearest number of that precision
(so that ``0.1`` is the double 0.1, and ``"0.1"`` is not). Results are then arrays of ``mpmath.mpf`` with all their bits.

Whatever is not finite or out of range is refused by a ScenarioError.
"""

from ._motions import FreeBody, LagrangeTop, State
from ._special_motions import (
    MeanRates,
    PrecessionRates,
    critical_spin,
    homoclinic_top,
    mean_rates,
    separatrix_free_body,
    steady_precession,
    steady_precession_rates,
    upright_growth_rate,
)
from ._turning_laboratory import (
    EARTH_RATE_RAD_S,
    FirstOrder,
    LaboratoryState,
    balanced_gyroscope_axis_L,
    balanced_gyroscope_drift,
    earth_rate_L,
    foucault_rate,
    resting_axis_L,
    seen_from_laboratory,
    sleeping_top_lean_south,
)

__all__ = [
    "EARTH_RATE_RAD_S",
    "FirstOrder",
    "FreeBody",
    "LaboratoryState",
    "LagrangeTop",
    "MeanRates",
    "PrecessionRates",
    "State",
    "balanced_gyroscope_axis_L",
    "balanced_gyroscope_drift",
    "critical_spin",
    "earth_rate_L",
    "foucault_rate",
    "homoclinic_top",
    "mean_rates",
    "resting_axis_L",
    "seen_from_laboratory",
    "separatrix_free_body",
    "sleeping_top_lean_south",
    "steady_precession",
    "steady_precession_rates",
    "upright_growth_rate",
]

# Pickles and help name the module that users know.
for _name in __all__:
    if hasattr(globals()[_name], "__module__"):
        globals()[_name].__module__ = __name__
