# SPDX-License-Identifier: GPL-3.0-or-later
"""First-order theory next to the vertical: a number, or nothing."""
import re

from case import Case


def numbers(text):
    return not re.search(r"\bnan\b|\binf\b", text)


CASES = [
    Case("run s.json --out r", "Drift after", scenario="toy-top", holds=numbers,
         set={"/release/tilt_deg": tilt, "/release/spin_rad_s": spin, "/motion": {"duration_s": 5, "output_step_s": 5}})
    for tilt, spin in ((179.99999986953875, -59.8353), (179.99999911593673, -80.79428), (179.99999976834457, -1.3981),
                       (0.05, 200), (1e-6, 100), (1e-9, 250))
]
