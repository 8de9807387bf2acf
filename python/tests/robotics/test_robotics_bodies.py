# SPDX-License-Identifier: BSD-3-Clause
"""Environments: against answers that are known, and against brute force."""

import numpy as np
import pytest

import hinge
import hinge.robotics as hr
from robot_cases import slider

SEED = 20260711


def test_distances_are_exact_and_points_lie_on_the_surfaces():
    world = hr.Environment()
    world.add(hr.Box((1, 9, 9)), (3, 0, 0), "wall")
    c = hr.Checker(slider(), environment=world)
    row = c.closest([1.0])[0]
    assert c.named(c.closest([1.0])) == [("cube", "wall")]
    assert (row["distance"], row["gap"], row["collides"]) == (1.0, 1.0, False)
    assert (row["point1"][0], row["point2"][0]) == (1.5, 2.5)
    assert row["normal"].tolist() == [1.0, 0.0, 0.0]
    assert c.collides([[1.9], [2.0], [2.1]]).tolist() == [False, True, True]  # touching collides
    assert c.distance([[1.5], [2.5]]).tolist() == [0.5, 0.0]
    near = hr.Checker(slider(), environment=world, clearance=0.25)
    assert near.collides([[1.74], [1.76]]).tolist() == [False, True]
    rows = near.distances([1.0], within=5.0)
    assert near.named(rows) == [("cube", "wall"), ("ball", "wall")]
    assert rows["gap"].tolist() == [0.75, 1.0]
    assert near.colliding_links([1.9]) == [("cube", "wall")]
    assert near.colliding_links([1.9], against="self") == []


def test_clearances_have_normals_depths_and_derivatives():
    world = hr.Environment()
    world.add(hr.Box((1, 9, 9)), (3, 0, 0), "wall")
    world.add(hr.Sphere(0.5), (0, 2, 0), "marble")
    c = hr.Checker(slider(), environment=world, clearance=0.25)
    rows, jacobian = c.clearances([1.0], influence=5.0, against="environment")
    assert jacobian.shape == (len(rows), c.dof)
    assert set(c.named(rows)) == {(x, y) for x in ("cube", "ball") for y in ("wall", "marble")}
    walls = [k for k, names in enumerate(c.named(rows)) if names == ("cube", "wall")]
    row = rows[walls[0]]
    assert (row["distance"], row["gap"], row["is_signed"]) == (1.0, 0.75, False)
    assert row["normal"].tolist() == [1.0, 0.0, 0.0] and jacobian[walls[0]].tolist() == [-1.0]

    # Several configurations, central differences, any number of threads.
    q = np.linspace(-1.5, 1.3, 40)[:, None]
    rows, jacobian = c.clearances(q, influence=9.0)
    again, slopes = c.clearances(q, influence=9.0, threads=3)
    assert rows.tobytes() == again.tobytes() and jacobian.tobytes() == slopes.tobytes()
    ahead, behind = c.clearances(q + 1e-6, influence=9.0)[0], c.clearances(q - 1e-6, influence=9.0)[0]
    assert len(ahead) == len(behind) == len(rows) > 100
    right, left = (ahead["distance"] - rows["distance"]) * 1e6, (rows["distance"] - behind["distance"]) * 1e6
    smooth = (np.abs(right - left) < 1e-3) & (np.linalg.norm(rows["normal"], axis=1) > 0)
    assert smooth.sum() > 100
    assert np.allclose(jacobian[smooth, 0], (right + left)[smooth] / 2, atol=1e-4)
    with pytest.raises(ValueError, match="influence"):
        c.clearances(q, influence=-1)


def test_relax():
    world = hr.Environment()
    world.add(hr.Box((1, 9, 9)), (3, 0, 0), "wall")
    c = hr.Checker(slider(), environment=world)
    found = c.relax([2.3])
    assert found.is_free and not c.collides(found.q) and 1.999 < found.q[0] < 2.0
    assert found.distance == pytest.approx(2.3 - found.q[0])
    assert c.relax([1.0]).q.tolist() == [1.0] and c.relax([1.0]).tries == 1
    q = np.linspace(1.5, 4.5, 13)[:, None]
    one, three = c.relax(q, seed=5, threads=1), c.relax(q, seed=5, threads=3)
    assert one.q.tobytes() == three.q.tobytes() and one.is_free.all()
    assert not c.collides(one.q).any()
    assert np.allclose(one.distance, np.abs(one.q - q)[:, 0])
    world.add(hr.Box((99, 9, 9)), name="room")
    stuck = c.relax([1.0], tries=50)
    assert not stuck.is_free and stuck.q.tolist() == [1.0] and stuck.tries == 50
    with pytest.raises(ValueError, match="tries"):
        c.relax([1.0], tries=0)


def test_random_spheres_against_brute_force():
    random = np.random.default_rng(SEED)
    centers, radii = random.uniform(-2, 2, (60, 3)), random.uniform(0.01, 0.2, 60)
    world = hr.Environment()
    for center, radius in zip(centers, radii):
        world.add(hr.Sphere(radius), center)
    balls, sizes = random.uniform(-0.5, 0.5, (5, 3)), random.uniform(0.05, 0.2, 5)
    robot = hr.Robot(
        ["root", hr.Link("cloud", [(hr.Sphere(r), x) for x, r in zip(balls, sizes)])],
        [hr.Joint("x", "prismatic", "root", "cloud", lower=-2, upper=2)],
    )
    c = hr.Checker(robot, environment=world)
    q = robot.sample(200, SEED)
    placed = balls + q[:, None, :] * [1.0, 0.0, 0.0]
    gaps = np.linalg.norm(placed[:, :, None] - centers, axis=-1) - sizes[:, None] - radii
    expected = gaps.min(axis=(1, 2))
    assert c.collides(q).tolist() == (expected <= 0).tolist(), f"seed {SEED}"
    assert np.allclose(c.distance(q), np.maximum(expected, 0), atol=1e-14), f"seed {SEED}"
    counts = np.bincount(c.pairs(q)["configuration"], minlength=200)
    assert counts.tolist() == (gaps.min(axis=1) <= 0).sum(axis=1).tolist()


def test_meshes_from_arrays_are_as_shapes():
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    faces = np.array([(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4)]
                     + [(2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)])
    box = hr.Mesh(corners, faces, solid=True)
    assert box.triangles.shape == (12, 3, 3)
    assert not box.triangles.flags.writeable
    assert np.array_equal(box.triangles, corners[faces])
    assert box.open_edge is None
    assert hr.Mesh(corners, faces[1:]).open_edge is not None
    assert np.array_equal(hr.Mesh(corners[faces]).triangles, box.triangles)
    world = hr.Environment()
    world.add(box, (3, 0, 0), "box")
    c = hr.Checker(slider(), environment=world)
    assert c.collides([[1.9], [2.0], [3.0]]).tolist() == [False, True, True]
    point = hr.Robot(["r", hr.Link("p", [hr.Sphere(0.01)])], [hr.Joint("x", "prismatic", "r", "p", upper=9)])
    assert hr.Checker(point, environment=world).collides([3.0])  # inside a solid
    hollow = hr.Environment()
    hollow.add(hr.Mesh(corners, faces), (3, 0, 0))
    assert not hr.Checker(point, environment=hollow).collides([3.0])
    assert hr.Checker(point, environment=hollow).named(hr.Checker(point, environment=hollow).contained([3.0])) == [
        ("body 0", "p")
    ]
    with pytest.raises(hinge.ModelError, match="body 0 'open': .* not closed"):
        hr.Environment().add(hr.Mesh(corners, faces[1:], solid=True), name="open")
    mirrored = hr.Mesh(corners, faces, scale=(-2, 1, 1))
    assert mirrored.scale.tolist() == [-2, 1, 1]
    # the mesh does not keep a reference to the caller's array
    kept = corners.copy()
    mesh = hr.Mesh(kept, faces)
    kept[:] = 0
    assert np.array_equal(mesh.triangles, corners[faces])
    view = hr.Mesh(corners, faces).triangles  # of a temporary
    assert np.array_equal(view, corners[faces])


def test_bodies_move_come_and_go():
    world = hr.Environment()
    c = hr.Checker(slider(), environment=world)
    assert not c.collides([0.0])
    assert world.add(hr.Box((1, 1, 1)), (0.5, 0, 0)) == "body 0"
    assert c.collides([0.0])
    world.set_pose("body 0", (5, 0, 0))
    assert not c.collides([0.0])
    assert world.pose("body 0")[0, 3] == 5
    for k in range(3000):  # more changes than copies repeat one by one
        world.set_pose("body 0", (5 + k % 7, 0, 0))
        if k % 500 == 0:
            assert c.collides([4.2 + k % 7])
    world.set_pose("body 0", (0, 0, 0))
    assert c.collides([[0.0], [3.0]]).tolist() == [True, False]
    second = world.add(hr.Sphere(1), (3, 0, 0), "second")
    assert (world.names, len(world), second in world) == (["body 0", "second"], 2, True)
    world.remove("body 0")
    assert c.collides([[0.0], [3.0]]).tolist() == [False, True]
    assert c.names.tolist() == ["root", "cube", "ball", "", "second"]
    assert c.colliding_links([3.0]) == [("cube", "second"), ("ball", "second")]
    for call in (lambda: world.pose("body 0"), lambda: world.remove("body 0"), lambda: world.set_pose("x", (0, 0, 0))):
        with pytest.raises(hinge.ModelError, match="no body '(body 0|x)', expected one of 'second'"):
            call()
    assert c.certify([-4.0], [0.0])["verdict"][0] == "free"
    assert c.certify([-4.0], [2.0])["verdict"][0] == "colliding"
    world.set_pose("second", (9, 0, 0))
    assert c.certify([-4.0], [2.0])["verdict"][0] == "free"  # path checkers see the change


def test_attach_detach_and_allow():
    world = hr.Environment()
    world.add(hr.Box((1, 1, 1)), (4, 0, 0), "wall")
    robot = slider()
    c = hr.Checker(robot, environment=world)
    assert not c.collides([1.5])
    tool = c.attach("cube", hr.Box((0.5, 0.1, 0.1)), (0.75, 0, 0), name="tool")
    assert (tool, world.attached_to("tool")) == ("tool", (robot, "cube"))
    assert c.colliding_links([2.6]) == [("tool", "wall")]
    assert not c.collides([2.4])
    assert c.closest([2.0])["distance"][0] == 0.5
    assert c.certify([0.0], [2.9])["verdict"][0] == "colliding"
    assert c.check_path([[0.0], [2.9]]).pairs == [("tool", "wall")]
    with pytest.raises(hinge.ConfigurationError, match="attached to link 'cube'"):
        world.set_pose("tool", (0, 0, 0))
    c.detach("tool", q=[2.0])  # it stays in the air
    assert world.pose("tool")[0, 3] == 2.75
    assert c.colliding_links([2.0]) == [("cube", "tool")]
    c.allow("tool", "cube")
    assert not c.collides([2.0])
    c.attach("ball", "tool")
    assert world.attached_to("tool") == (robot, "ball")
    c.detach("tool")
    assert world.pose("tool")[0, 3] == 2.75
    c.attach("ball", "tool")
    c.detach("tool", remove=True)
    assert world.names == ["wall"]
    with pytest.raises(hinge.ModelError, match="not attached"):
        c.detach("wall")
    with pytest.raises(hinge.ModelError, match="has no link 'nose'"):
        c.attach("nose", hr.Sphere(1), name="failed")
    assert world.names == ["wall"]
    alone = hr.Checker(slider())
    alone.attach("cube", hr.Sphere(0.1), (0, 0, 5))
    assert alone.environment.names == ["body 0"]
    assert alone.colliding_links([0.0]) == []


def test_two_robots():
    robot = slider()
    left, right = hr.Checker(robot), hr.Checker(robot, base=(4, 0, 0))
    assert right.base[0, 3] == 4
    assert right.link_poses([1.0])[1, 0, 3] == 5
    assert not left.collides_with(right, [0.0], [0.0])
    q, r = np.array([[0.0], [1.0], [3.5]]), np.array([[0.0], [-2.0], [0.0]])
    assert left.collides_with(right, q, r).tolist() == [False, True, True]
    assert left.collides_with(right, q, r[0], threads=2).tolist() == [False, False, True]
    rows = left.closest_with(right, q, r)
    assert rows["distance"].tolist() == [3.0, 0.0, 0.0]
    pairs = left.pairs_with(right, [3.0], [0.0])
    assert [(robot.link_names[row["first"]], robot.link_names[row["second"]]) for row in pairs] == [("cube", "cube")]
    assert len(left.pairs_with(right, q[0], r[0], within=9.0)) == 4
    right.base = (8, 0, 0)
    assert left.closest_with(right, [0.0], [0.0])["distance"][0] == 7.0
    with pytest.raises(ValueError, match="other: the checker itself"):
        left.collides_with(left, [0.0], [0.0])
    with pytest.raises(ValueError, match="3 and 2 configurations"):
        left.collides_with(right, q, r[:2])
    with pytest.raises(ValueError, match="q_other: shape"):
        left.collides_with(right, q, [[0.0, 1.0]])


def test_one_environment_of_two_robots():
    world = hr.Environment()
    world.add(hr.Box((1, 1, 1)), (2, 0, 0), "crate")
    a, b = slider(), slider()
    first, second = hr.Checker(a, environment=world), hr.Checker(b, environment=world)
    first.attach("cube", "crate", (1, 0, 0))
    assert not first.collides([1.5])  # it holds the crate
    assert second.collides([1.5])  # for the other robot, the crate stands where it stood
    with pytest.raises(hinge.ModelError, match="not attached to this robot"):
        second.detach("crate")
