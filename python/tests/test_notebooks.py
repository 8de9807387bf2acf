# SPDX-License-Identifier: BSD-3-Clause
"""Executes the notebooks of docs/notebooks and compares the numbers of their texts with what they compute."""

import base64
import importlib.util
import os
import pathlib
import re

import pytest

import hinge
from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "docs/notebooks").glob("*.ipynb"))
NEEDED = {
    "nbformat": "python3-nbformat",
    "nbclient": "python3-nbclient",
    "ipykernel": "python3-ipykernel",
    "matplotlib": "python3-matplotlib",
}
NUMBER = r"\*\*([0-9.]+)\*\*"


def read(path):
    import nbformat

    return nbformat.read(path, as_version=4)


def needs_jupyter():
    missing = [package for module, package in NEEDED.items() if importlib.util.find_spec(module) is None]
    if missing:
        pytest.skip("not installed: " + ", ".join(missing))


def printed(cell):
    """The text that a cell printed or returned."""
    return " ".join(o.get("text", "") or o.get("data", {}).get("text/plain", "") for o in cell.get("outputs", []))


def numbers(text):
    return re.findall(r"\d+(?:\.\d+)?", text)


def wrong_numbers(cells):
    """The bold numbers of texts that the last printing cell above did not print, and the count of bold numbers."""
    wrong, count, last = [], 0, ""
    for cell in cells:
        if cell["cell_type"] == "code":
            last = printed(cell) if re.search(r"\d", printed(cell)) else last
        else:
            stated = re.findall(NUMBER, cell["source"])
            count += len(stated)
            wrong += [number for number in stated if number not in numbers(last)]
    return wrong, count


def test_there_is_one_of_a_protein_and_one_of_a_robot():
    assert {path.stem for path in NOTEBOOKS} >= {"protein", "robot"}


@pytest.mark.long
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_notebook_runs_and_states_what_it_computes(path, monkeypatch):
    needs_jupyter()
    from nbclient import NotebookClient

    package = str(pathlib.Path(hinge.__file__).parents[1])
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([package, os.environ.get("PYTHONPATH", "")]))
    monkeypatch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    notebook = read(path)
    NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(path.parent)}}).execute()
    pictures = 0
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            assert output["output_type"] != "error"
            assert output.get("name") != "stderr", output["text"]
            if "image/png" in output.get("data", {}):
                pictures += 1
                assert base64.b64decode(output["data"]["image/png"]).startswith(b"\x89PNG")
    assert pictures >= 3
    wrong, count = wrong_numbers(notebook.cells)
    assert not wrong and count >= 5, f"stated, but not printed by the cell above: {wrong}"
    # The test itself: another number is noticed.
    for cell in notebook.cells:
        if cell["cell_type"] == "markdown":
            cell["source"] = re.sub(NUMBER, "**987654321**", cell["source"])
    assert len(wrong_numbers(notebook.cells)[0]) == count


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_notebook_is_stored_without_outputs(path):
    if importlib.util.find_spec("nbformat") is None:
        pytest.skip("not installed: python3-nbformat")
    for cell in read(path).cells:
        assert not cell.get("outputs") and cell.get("execution_count") is None


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_notebook_is_linked(path):
    pages = [ROOT / "README.md", *(ROOT / "docs/tutorial").glob("python_*.md")]
    assert sum(path.name in page.read_text() for page in pages) >= 2
