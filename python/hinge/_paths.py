# SPDX-License-Identifier: BSD-3-Clause
"""Options and answers of certify(), which all checkers share."""

import math
import numbers

import numpy as np

_VERDICTS = np.array(["free", "colliding", "undecided"])


def path_options(smallest_step, resolution):
    """(smallest_step, resolution) as floats; the resolution is 0 for a proof."""
    for name, value in (("smallest_step", smallest_step), ("resolution", resolution)):
        if value is not None and (isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Real)):
            raise TypeError(f"{name}: a {type(value).__name__}, expected a number")
    if smallest_step is None or not 0 < smallest_step <= 1:
        raise ValueError(f"smallest_step: {smallest_step}, expected a share of the path above 0, at most 1")
    if resolution is not None and not (0 < resolution and math.isfinite(resolution)):
        raise ValueError(f"resolution: {resolution}, expected a finite number above 0, or None")
    return float(smallest_step), float(resolution or 0.0)


def named_verdicts(rows):
    """The rows of the compiled part, with verdicts as words."""
    fields = [(name, "U9" if name == "verdict" else rows.dtype[name]) for name in rows.dtype.names]
    named = np.empty(rows.shape, fields)
    for name in rows.dtype.names:
        named[name] = _VERDICTS[rows[name]] if name == "verdict" else rows[name]
    return named
