# SPDX-License-Identifier: BSD-3-Clause
"""Runs the Python code of the documentation and compares its output."""

import doctest
import re

import pytest

from conftest import ROOT

PAGES = {page: 10 for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("python_*.md"))]}  # least examples
PAGES[ROOT / "docs/guide/see_it_in_a_browser.md"] = 5


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.stem)
def test_output_is_as_shown(page, monkeypatch, tmp_path):
    for folder in ("molecular", "robotics"):  # files that the code writes must not be among the sources
        (tmp_path / folder).symlink_to(ROOT / folder)
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)
    assert blocks, f"{page} has no ```python block"
    parser = doctest.DocTestParser()
    examples = [example for block in blocks for example in parser.get_examples(block)]
    assert len(examples) >= PAGES[page], page
    test = doctest.DocTest(examples, {}, page.stem, str(page), 0, None)
    output = []
    result = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test, out=output.append)
    assert result.failed == 0, "".join(output)
