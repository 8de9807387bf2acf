# SPDX-License-Identifier: BSD-3-Clause
"""Collects the pages of the site in build/docs-pages, and writes build/mkdocs.yml.

The folders are those of the repository, so links between pages stay as they are. The navigation is the list of links
in docs/index.md. A link to a public header opens its page of the C++ reference. A link to another source file opens a
page with its text. Doxygen has run before.
"""

import json
import os
import pathlib
import re
import xml.etree.ElementTree as xml

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "build/docs-pages"
SHOWN_AS_TEXT = {".cpp": "cpp", ".hpp": "cpp", ".cff": "yaml", ".txt": "cmake", ".py": "python"}
LINK = re.compile(r"\]\(([^)#:\s]+)(#[^)]*)?\)")


def reference_pages():
    """Returns the page of each public header in the C++ reference, by path."""
    tags = xml.parse(ROOT / "build/api.tag").getroot()
    files = [entry for entry in tags if entry.get("kind") == "file"]
    return {
        pathlib.Path(entry.findtext("path"), entry.findtext("name")): PAGES / "api" / entry.findtext("filename")
        for entry in files
    }


def notebook_text(path):
    """Returns the cells of a notebook as Markdown."""
    cells = json.loads(path.read_text())["cells"]
    texts = [("".join(cell["source"]), cell["cell_type"]) for cell in cells]
    return "\n\n".join(text if kind == "markdown" else f"```python\n{text}\n```" for text, kind in texts)


def collect(source, headers):
    """Writes one page, and the files it links to that are no pages themselves."""
    page = PAGES / source.relative_to(ROOT)
    page.parent.mkdir(parents=True, exist_ok=True)

    def redirected(match):
        target = pathlib.Path(os.path.normpath(source.parent / match[1]))
        copy = PAGES / target.relative_to(ROOT)
        if target in headers:
            copy = headers[target]
        elif target.suffix == ".ipynb":
            copy = copy.with_name(copy.name + ".md")
            write(copy, notebook_text(target))
        elif target.suffix in SHOWN_AS_TEXT:
            copy = copy.with_name(copy.name + ".md")
            write(copy, f"# {target.name}\n\n```{SHOWN_AS_TEXT[target.suffix]}\n{target.read_text()}\n```\n")
        elif target.is_file() and target.suffix != ".md":
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(target.read_bytes())
        return f"]({os.path.relpath(copy, page.parent)}{match[2] or ''})"

    write(page, LINK.sub(redirected, source.read_text()))


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def navigation():
    """Returns the headings of docs/index.md with their links, as YAML."""
    lines = ["nav:", '  - "All pages": docs/index.md']
    for line in (ROOT / "docs/index.md").read_text().splitlines():
        if line.startswith("## "):
            lines.append(f'  - "{line[3:]}":')
        for title, target in re.findall(r"^\* \[([^]]+)\]\(([^)#]+)\)", line):
            path = os.path.relpath(os.path.normpath(ROOT / "docs" / target), ROOT)
            lines.append(f'    - "{title}": {path + ("" if path.endswith(".md") else ".md")}')
    return "\n".join(lines) + "\n"


def main():
    headers = reference_pages()
    for source in [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]:
        collect(source, headers)
    write(PAGES / "site.css", (ROOT / "docs/site/site.css").read_text())
    write(
        ROOT / "build/mkdocs.yml",
        f"INHERIT: {ROOT}/docs/site/mkdocs.yml\ndocs_dir: {PAGES}\nsite_dir: {ROOT}/build/docs\n{navigation()}",
    )


main()
