# SPDX-License-Identifier: BSD-3-Clause
"""hinge.report(): its data are those of the tools' pages for the same question."""

import base64
import json
import re
import subprocess

import numpy as np
import pytest

import hinge
import hinge.molecular as hm
import hinge.robotics as hr
from conftest import ROOT, tool
from robot_cases import ARM

UBIQUITIN = ROOT / "molecular/data/1ubq.pdb"
ARM_FILES = [str(ARM), "--srdf", str(ARM.with_suffix(".srdf"))]
SHELF = ROOT / "robotics/data/shelf.obj"


def data_of(page):
    return json.loads(re.search(r'id="hinge-data">(.*?)</script>', page, re.S)[1])


def page_of_tool(tmp_path, *words):
    """The data of the page that a tool writes."""
    file = tmp_path / "tool.html"
    done = subprocess.run([tool(words[0]), *map(str, words[1:]), "--report", str(file)], capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    return data_of(file.read_text())


def decoded(text, dtype):
    return np.frombuffer(base64.b64decode(text), dtype)


def arm(**options):
    robot = hr.Robot.from_urdf(ARM, srdf=ARM.with_suffix(".srdf"))
    environment = hr.Environment()
    environment.add(hr.Mesh.read(SHELF), name="shelf")
    return hr.Checker(robot, environment=environment, **options)


@pytest.mark.parametrize("free", ["all", "A:70-76"])
def test_a_molecule_is_that_of_the_tool(tmp_path, free):
    expected = page_of_tool(tmp_path, "biocd", "sample", UBIQUITIN, "--free", free, "--sigma", 3, "--seed", 4, "-n", 70)
    checker = hm.Checker(hm.Molecule(UBIQUITIN), free)
    data = data_of(hinge.report(checker, checker.sample(70, seed=4, sigma=np.radians(3))).html)
    assert data.keys() == expected.keys()
    for name in ("format", "format_version", "kind", "version", "sequence", "frame_word", "first_number", "all_frames"):
        assert data[name] == expected[name], name
    assert (data["frames_left_out"], data["frames_text"]) == (20, expected["frames_text"])
    assert data["verdict"] == expected["verdict"]
    assert [f["sha256"] for f in data["files"]] == [f["sha256"] for f in expected["files"]]
    assert data["molecule"] == expected["molecule"]
    assert len(data["frames"]) == 50
    for frame, other in zip(data["frames"], expected["frames"]):
        assert frame == other


def test_coordinates_are_shown_as_given(tmp_path):
    molecule = hm.Molecule(UBIQUITIN)
    checker = hm.Checker(molecule)
    data = data_of(hinge.report(checker, coordinates=molecule.coordinates, within=0.3).html)
    near = checker.pairs_coordinates(molecule.coordinates, within=0.3)
    frame, m = data["frames"][0], data["molecule"]
    assert len(frame["pairs"]) == len(near) > 0
    assert sum(row[4] for row in frame["pairs"]) == near["collides"].sum() < len(near)
    x = np.array(m["origin"]) + m["unit"] * decoded(frame["coordinates"], "<i2").reshape(-1, 3)
    assert np.abs(x - molecule.coordinates).max() <= 0.5 * m["unit"] + 1e-9


def test_a_large_molecule_is_cut_to_what_can_be_shown(shared, tmp_path):
    file = shared("molecules/2btv.pdb.gz")
    expected = page_of_tool(tmp_path, "biocd", "check", file)
    molecule = hm.Molecule(str(file))
    checker = hm.Checker(molecule)
    data = data_of(hinge.report(checker, coordinates=molecule.coordinates).html)
    assert "CA and P atom" in data["molecule"]["cut"]
    assert data["molecule"] == expected["molecule"]
    assert data["frames"][0]["pairs"] == expected["frames"][0]["pairs"]


@pytest.mark.parametrize("mode", [0.0, 0.05])
def test_a_robot_is_that_of_the_tool(tmp_path, mode):
    more = ["--mode", f"within:{mode}"] if mode else []
    words = ["check", *ARM_FILES, "--env", f"shelf={SHELF}", "--random", 60, "--seed", 3, *more]
    expected = page_of_tool(tmp_path, "robocd", *words)
    checker = arm()
    data = data_of(hinge.report(checker, checker.robot.sample(60, seed=3), within=mode).html)
    for name in ("kind", "verdict", "all_frames", "frames_left_out", "frames_text", "first_number", "title"):
        assert data[name] == expected[name], name
    assert [f["sha256"] for f in data["files"]] == [f["sha256"] for f in expected["files"][:1]]
    for frame, other in zip(data["frames"], expected["frames"]):
        pairs, others = frame.pop("pairs"), other.pop("pairs")
        poses, other_poses = frame.pop("poses"), other.pop("poses")
        assert frame == other
        assert np.allclose(decoded(poses, "<f4"), decoded(other_poses, "<f4"), rtol=0, atol=1e-6)
        assert sorted(row[:2] + [row[4]] for row in pairs) == sorted(row[:2] + [row[4]] for row in others)
        assert np.allclose([row[2] for row in pairs], [row[2] for row in others], rtol=0, atol=1e-12)
    robot, other = data["robot"], expected["robot"]
    assert robot["joints"] == other["joints"]
    for part, another in zip(robot["links"] + robot["bodies"], other["links"] + other["bodies"]):
        assert (part["name"], part.get("moves"), part.get("pose")) == (
            another["name"], another.get("moves"), another.get("pose"))  # fmt: skip
        assert np.allclose(corners(part), corners(another), rtol=0, atol=1e-6)


def corners(part):
    """The corners of a part's triangles, in a fixed order."""
    vertices = decoded(part["vertices"], "<f4").reshape(-1, 3)
    triangles = vertices[decoded(part["triangles"], "<u4").reshape(-1, 3)].reshape(-1, 9)
    return triangles[np.lexsort(np.round(triangles.T, 5))]


def test_a_matrix_is_that_of_the_tool(tmp_path):
    expected = page_of_tool(tmp_path, "robocd", "matrix", *ARM_FILES, "--samples", 500)
    checker = arm()
    matrix = hr.CollisionMatrix(checker.robot, samples=500)
    assert data_of(hinge.report(checker, matrix=matrix).html)["robot"]["matrix"] == expected["robot"]["matrix"]


def test_a_motion_plays(tmp_path):
    checker = arm()
    motion = checker.plan(checker.robot.state("arm/home"), checker.robot.state("arm/reach"))
    data = data_of(hinge.report(checker, motion).html)
    assert data["sequence"] == "path"
    assert data["verdict"]["state"] == "free"
    assert 100 < len(data["frames"]) <= 201
    values = np.array([frame["values"] for frame in data["frames"]])
    for waypoint in motion.waypoints:
        assert (np.abs(values - waypoint).max(axis=1) == 0).any()
    # The straight motion runs into the shelf.
    ends = np.array([motion.waypoints[0], motion.waypoints[-1]])
    straight = ends[0] + np.linspace(0, 1, 80)[:, None] * (ends[1] - ends[0])
    data = data_of(hinge.report(checker, straight, path=True, names=[f"t{k}" for k in range(80)]).html)
    assert (len(data["frames"]), data["frames"][7]["name"], data["verdict"]["state"]) == (80, "t7", "collides")


def test_a_body_moves_with_the_link_that_holds_it():
    checker = arm()
    checker.environment.add(hr.Sphere(0.1), name="gone")
    checker.environment.remove("gone")
    checker.attach("hand", hr.Box((0.05, 0.06, 0.4)), (0, 0, 0.1), name="tool")
    checker.environment.add(hr.Box((0.2, 0.2, 0.2)), checker.link_poses(np.zeros(6))[-1], "block")
    data = data_of(hinge.report(checker).html)
    robot, frame = data["robot"], data["frames"][0]
    names = [part["name"] for part in robot["links"] + robot["bodies"]]
    assert names == [*checker.robot.link_names, "tool", "shelf", "block"]
    poses = decoded(frame["poses"], "<f4").reshape(-1, 3, 4)
    at = checker.link_poses(np.zeros(6))[checker.robot.link_names.index("hand")]
    assert np.allclose(poses[8], (at @ hr.pose((0, 0, 0.1)))[:3], atol=1e-6)
    shown = {(names[row[0]], names[row[1]]) for row in frame["pairs"] if row[4]}
    assert shown == set(checker.colliding_links(np.zeros(6)))
    assert ("tool" in {name for pair in shown for name in pair}) and robot["links"][8]["moves"] == 1


def test_large_meshes_are_drawn_coarser():
    x = np.linspace(0, 4 * np.pi, 260)
    grid = np.stack([*np.meshgrid(x, x, indexing="ij"), np.sin(x)[:, None] * np.cos(x)], axis=-1).reshape(-1, 3)
    k = (np.arange(259)[:, None] * 260 + np.arange(259)).reshape(-1)
    faces = np.concatenate([np.stack([k, k + 1, k + 260], 1), np.stack([k + 1, k + 261, k + 260], 1)])
    environment = hr.Environment()
    environment.add(hr.Mesh(grid, faces), (5, 5, 5), "hill")
    checker = hr.Checker(hr.Robot.from_urdf(ARM), environment=environment)
    robot = data_of(hinge.report(checker).html)["robot"]
    assert "are drawn coarser" in robot["cut"]
    hill = robot["bodies"][0]
    drawn = len(decoded(hill["triangles"], "<u4")) // 3
    assert 20_000 < drawn < 100_000
    assert np.abs(corners(hill)).max() < 4 * np.pi + 1e-3
    assert hill["pose"][3::4] == [5, 5, 5]


def test_files_are_complete_or_absent(tmp_path):
    checker = hm.Checker(hm.Molecule(UBIQUITIN), "A:70-76")
    page = hinge.report(checker, file=tmp_path / "a.html", title="</script><b>\u00e9\u2028\"'")
    assert (tmp_path / "a.html").read_text() == page.html
    assert data_of(page.html)["title"] == "</script><b>\u00e9\u2028\"'"
    assert "\\u003c/script>\\u003cb>" in page.html
    assert [f.name for f in tmp_path.iterdir()] == ["a.html"]
    with pytest.raises(ValueError, match="ends with .html"):
        page.save(tmp_path / "a.txt")
    with pytest.raises(ValueError, match="ends with .html"):
        page.save(tmp_path / "a.htm")
    with pytest.raises(OSError):
        page.save(tmp_path / "nowhere" / "a.html")
    assert page._repr_html_().startswith("<iframe") and "MB" in repr(page)


def test_bad_arguments_are_named():
    checker, robot = hm.Checker(hm.Molecule(UBIQUITIN), "A:70-76"), arm()
    with pytest.raises(TypeError, match="checker: a str"):
        hinge.report("1ubq.pdb")
    with pytest.raises(TypeError, match="coordinates: given with a robot"):
        hinge.report(robot, coordinates=np.zeros((3, 3)))
    with pytest.raises(TypeError, match="matrix: given with a molecule"):
        hinge.report(checker, matrix=1)
    with pytest.raises(TypeError, match="q: a str, .* path is the argument file"):
        hinge.report(checker, "page.html")
    with pytest.raises(TypeError, match="both given"):
        hinge.report(checker, np.zeros(checker.dof), coordinates=np.zeros((1, 3)))
    with pytest.raises(ValueError, match="names: 2 of them, expected 1"):
        hinge.report(robot, names=["a", "b"])
    with pytest.raises(ValueError, match="q: empty"):
        hinge.report(robot, np.zeros((0, 6)))
    with pytest.raises(ValueError, match="within"):
        hinge.report(robot, within=-1)
    with pytest.raises(ValueError, match="shape"):
        hinge.report(robot, np.zeros((2, 99)))
    with pytest.raises(TypeError, match="CollisionMatrix"):
        hinge.report(robot, matrix=[])
