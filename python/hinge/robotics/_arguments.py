# SPDX-License-Identifier: BSD-3-Clause
"""Checks of arguments that are not arrays."""

import math
import numbers
import os


def number(name, value, *, positive=False):
    """A finite real number as a float; at least 0 if positive."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name}: a {type(value).__name__}, expected a real number")
    value = float(value)
    if not math.isfinite(value) or (positive and value < 0):
        raise ValueError(f"{name}: {value}, expected a finite number" + (" of at least 0" if positive else ""))
    return value


def count(name, value, least=0):
    """An integer of at least `least`."""
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise TypeError(f"{name}: a {type(value).__name__}, expected an integer")
    if not least <= value < 2**53:
        raise ValueError(f"{name}: {value}, expected {least} to 2**53 - 1")
    return int(value)


def seed(value):
    """An integer from 0 to 2**64 - 1."""
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise TypeError(f"seed: a {type(value).__name__}, expected an integer")
    if not 0 <= value < 2**64:
        raise ValueError(f"seed: {value}, expected 0 to 2**64 - 1")
    return int(value)


def one_of(name, value, allowed):
    """The value, one of a few strings."""
    if value not in allowed:
        raise ValueError(f"{name}: {value!r}, expected {', '.join(map(repr, allowed))}")
    return value


def text(name, value):
    """A str."""
    if not isinstance(value, str):
        raise TypeError(f"{name}: a {type(value).__name__}, expected a str")
    return value


def path(name, value):
    """A path as a str."""
    try:
        return os.fsdecode(value)
    except TypeError:
        raise TypeError(f"{name}: a {type(value).__name__}, expected a path") from None


def pair_names(name, pairs):
    """Pairs of names as a list of tuples."""
    if isinstance(pairs, str):
        raise TypeError(f"{name}: a str, expected pairs of names, such as [('base', 'hand')]")
    found = []
    for pair in pairs:
        if isinstance(pair, str) or len(pair) != 2:
            raise ValueError(f"{name}: {pair!r}, expected a pair of names")
        found.append((text(name, pair[0]), text(name, pair[1])))
    return found
