# SPDX-License-Identifier: BSD-3-Clause
import numpy as np

from ._checker import Checker as Checker, PathAnswer as PathAnswer, Relaxation as Relaxation
from ._description import Joint as Joint, Link as Link, Mimic as Mimic
from ._environment import Environment as Environment
from ._matrix import CollisionMatrix as CollisionMatrix
from ._robot import Robot as Robot
from ._shapes import (
    Box as Box,
    Capsule as Capsule,
    Cylinder as Cylinder,
    Mesh as Mesh,
    PointCloud as PointCloud,
    Shape as Shape,
    Sphere as Sphere,
    pose as pose,
)

__all__ = [
    "Box",
    "Capsule",
    "Checker",
    "CollisionMatrix",
    "Cylinder",
    "Environment",
    "Joint",
    "Link",
    "Mesh",
    "Mimic",
    "PathAnswer",
    "PointCloud",
    "Relaxation",
    "Robot",
    "Shape",
    "Sphere",
    "distance_dtype",
    "pair_dtype",
    "pose",
]

distance_dtype: np.dtype[np.void]
pair_dtype: np.dtype[np.void]
