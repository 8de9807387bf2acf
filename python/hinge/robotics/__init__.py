# SPDX-License-Identifier: BSD-3-Clause
"""Robots of triangle meshes and simple shapes, against themselves, each other and the bodies around them. Lengths are
in m, angles in rad.

    import hinge.robotics as hr
    robot = hr.Robot.from_urdf("arm.urdf", srdf="arm.srdf")
    world = hr.Environment()
    world.add(hr.Box((1, 2, 0.05)), (0.5, 0, -0.1), "table")
    c = hr.Checker(robot, environment=world)
    q = robot.sample(10_000)                     # shape (n, dof)
    c.collides(q).mean()                         # share that collides
    c.colliding_links(q[0])                      # names
    c.closest(q[:10])["distance"]                # and points, normals
    c.certify(q[0], q[1])                        # is the motion free all the way? A proof

A configuration holds one value per independent joint, in the order of robot.joint_names; mimic joints follow.
"""

from .._core import robotics as _core
from ._checker import Checker, PathAnswer, Relaxation
from ._description import Joint, Link, Mimic
from ._environment import Environment
from ._matrix import CollisionMatrix
from ._robot import Robot
from ._shapes import Box, Capsule, Cylinder, Mesh, PointCloud, Shape, Sphere, pose

distance_dtype = _core.distance_dtype
pair_dtype = _core.pair_dtype

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

for _name in __all__:
    if callable(globals()[_name]):
        globals()[_name].__module__ = __name__
del _name
