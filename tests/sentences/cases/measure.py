# SPDX-License-Identifier: GPL-3.0-or-later
"""What `compare` says of a measurement, and `plan` of a planned one."""
from case import Case

CASES = [
    Case("plan s.json --measure azimuth_deg --sigma 0.01 --every 1 --set '/uncertainty={\"latitude_deg\": 1}'",
         "the stated uncertainty of latitude_deg says how well omega_sin_latitude_rad_s is known; it is no datum",
         scenario="free-gyro"),
    Case("plan s.json --measure azimuth_deg --sigma 0.01 --every 1 --estimate tilt_deg --nuisance /release/azimuth_deg",
         "tilt_deg would be known to ± ", scenario="toy-top"),
]
