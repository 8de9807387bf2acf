# SPDX-License-Identifier: BSD-3-Clause
"""Robots against themselves and the bodies around them. Lengths are in metres, angles in radians."""

__all__: list = []
