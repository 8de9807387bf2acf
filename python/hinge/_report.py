# SPDX-License-Identifier: BSD-3-Clause
"""report(): conformations and their collisions as a page for a browser, as the tools write it with --report."""

import base64
import hashlib
import json
import numbers
import os
import pathlib
import threading
from html import escape

import numpy as np

from . import _core
from ._planning import Motion, states_along

_MOST_FRAMES = 50  # as ReportChoice of the tools
_MOST_CHARTED = 200_000
_STATES_OF_A_MOTION = 200
_BLOCK = 1024  # configurations whose pairs are in memory at the same time


class Report:
    """A page that shows conformations or configurations in any browser, without network.

    html: the text of the page. In a notebook the object shows itself. Raises nothing; report() makes it.
    """

    def __init__(self, html):
        self.html = html

    def save(self, file):
        """Write the page to a file, which appears when it is complete.

        file: a path that ends with .html. Raises ValueError for other names, and OSError if it cannot be written.
        """
        file = pathlib.Path(os.fsdecode(file))
        if file.suffix != ".html":
            raise ValueError(f"file: {str(file)!r}, expected a name that ends with .html")
        temporary = file.with_name(f".{file.name}.{os.getpid()}.{threading.get_ident()}")
        try:
            temporary.write_text(self.html, encoding="utf-8")
            temporary.replace(file)
        finally:
            temporary.unlink(missing_ok=True)

    def _repr_html_(self):
        return (
            '<iframe sandbox="allow-scripts" style="width:100%;height:800px;border:0" '
            f'srcdoc="{escape(self.html)}"></iframe>'
        )

    def __repr__(self):
        return f"<Report of {len(self.html) / 1e6:.1f} MB>"


def report(
    checker,
    q=None,
    file=None,
    *,
    coordinates=None,
    within=0.0,
    path=False,
    names=None,
    title=None,
    matrix=None,
    threads=None,
):
    """Make a page that shows conformations in 3D, with the table of their pairs and charts. Returns a Report.

    checker: a hinge.molecular.Checker or hinge.robotics.Checker. q: what to show, shape (dof,) or (n, dof), or a Motion;
    None: the reference of a molecule, the zero configuration of a robot. file: also write the page to this path, which
    ends with .html.
    coordinates: of a molecule, instead of q: shape (n_atoms, 3) or (n, n_atoms, 3), angstrom, or a Trajectory. within:
    also list pairs that are closer than their threshold and this, angstrom or m.
    path: the rows of q follow each other in time; all are shown. Of a Motion, about 200 states are. Otherwise the 50
    with the most colliding pairs are shown, and all are counted. names: of all n. title: of the page; None: the model's
    name. matrix: of a robot, a CollisionMatrix to show beside. threads: as in collides().
    Raises TypeError, ValueError, and OSError if the file cannot be written.
    """
    from . import molecular, robotics

    if isinstance(within, bool) or not isinstance(within, numbers.Real) or not 0 <= within < np.inf:
        raise ValueError(f"within: {within!r}, expected a finite length of at least 0")
    if isinstance(checker, molecular.Checker):
        if matrix is not None:
            raise TypeError("matrix: given with a molecule, expected None")
        from .molecular._page import MoleculePage as Page
    elif isinstance(checker, robotics.Checker):
        if coordinates is not None:
            raise TypeError("coordinates: given with a robot, expected None")
        from .robotics._page import RobotPage as Page
    else:
        raise TypeError(
            f"checker: a {type(checker).__name__}, expected a hinge.molecular.Checker or hinge.robotics.Checker"
        )
    if isinstance(q, (str, bytes, os.PathLike)):
        raise TypeError(f"q: a {type(q).__name__}, expected numbers or a Motion; the page's path is the argument file")
    if q is not None and coordinates is not None:
        raise TypeError("q and coordinates: both given, expected one of them")
    verdict = None
    if isinstance(q, Motion):
        path, verdict = True, _verdict_of_motion(q, Page.length_unit)
        q = states_along(q.waypoints, lambda a, b: _STATES_OF_A_MOTION // (len(q.waypoints) - 1))
    if coordinates is None:
        q = np.atleast_2d(np.zeros(checker.dof) if q is None else np.asarray(q, np.float64))
    page = Page(checker, q, coordinates, float(within), threads)
    if page.count == 0:
        raise ValueError(f"{'q' if coordinates is None else 'coordinates'}: empty, expected at least one to show")
    choice = _choose(page, bool(path))
    word = page.frame_word
    if names is not None and len(names) != page.count:
        raise ValueError(f"names: {len(names)} of them, expected {page.count}")
    colliding = int(choice["collides"].sum())
    data = {
        "format": "hinge-report",
        "format_version": 1,
        "kind": page.kind,
        "title": page.title if title is None else str(title),
        "tool": "hinge.report()",
        "version": _core.version,
        "command": "",
        "verdict": verdict or {"state": "collides" if colliding else "free", "text": _tally(colliding, page.count, word)},
        "question": [{"name": name, "value": value} for name, value in page.question()],
        "files": [{"name": name, "sha256": _digest(name)} for name in page.files()],
        "notes": page.notes(),
        "sequence": "path" if path else "frames",
        "frame_word": [word, f"{word}s"],
        "first_number": 0,
        "all_frames": choice["all"],
        "frames_left_out": page.count - len(choice["shown"]),
        "frames_text": choice["text"],
    }
    shown_names = [f"{word} {k}" if names is None else str(names[k]) for k in choice["shown"]]
    data.update(page.data(choice["shown"], shown_names))
    if matrix is not None:
        data["robot"]["matrix"] = page.matrix(matrix)
    text = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    program = (pathlib.Path(__file__).parent / "_pages" / f"{page.kind}.html").read_text(encoding="utf-8")
    made = Report(program.replace("@HINGE_REPORT_DATA@", text, 1))
    if file is not None:
        made.save(file)
    return made


def packed(values, dtype):
    """Numbers as little-endian bytes in base64."""
    return base64.b64encode(np.ascontiguousarray(values, np.dtype(dtype).newbyteorder("<")).tobytes()).decode()


def counted(count, word):
    """Such as '1 atom' or '2 atoms'."""
    return f"{count} {word}{'' if count == 1 else 's'}"


def _tally(colliding, count, word):
    """The verdict about all."""
    if count == 1:
        return f"the {word} {'collides' if colliding else 'is free'}"
    if colliding == 0:
        return f"all {count} {word}s are free"
    return f"{colliding} of {counted(count, word)} {'collides' if colliding == 1 else 'collide'}"


def _verdict_of_motion(motion, unit):
    if motion.reached:
        return {"state": "free", "text": f"a motion was found, {motion.length:.3f} {unit} long, proved free"}
    text = f"no motion was found; the nearest that was reached is {motion.remaining:.3f} {unit} from the end"
    return {"state": "undecided", "text": text}


def _choose(page, is_path):
    """Counts the colliding pairs of all, and chooses which ones to show."""
    counts = np.zeros(page.count, np.uint32)
    for first in range(0, page.count, _BLOCK):
        last = min(page.count, first + _BLOCK)
        counts[first:last] = page.count_pairs(first, last)
    shown = np.arange(page.count)
    text = ""
    if not is_path and page.count > _MOST_FRAMES:
        shown = np.sort(np.argsort(-counts.astype(np.int64), kind="stable")[:_MOST_FRAMES])
        text = f"the {_MOST_FRAMES} with the most colliding pairs"
    all_frames = None
    if page.count <= _MOST_CHARTED:
        all_frames = {"count": page.count, "collides": packed(counts > 0, "u1"), "pairs": packed(counts, "u4")}
    return {"collides": counts > 0, "shown": shown.tolist(), "text": text, "all": all_frames}


def _digest(path):
    """The SHA-256 digest of a regular file, otherwise ''."""
    try:
        return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest() if os.path.isfile(path) else ""
    except OSError:
        return ""
