# SPDX-License-Identifier: BSD-3-Clause
"""Checks the links of the pages, with their anchors: /usr/bin/python3 check_links.py [--site] FOLDER.

FOLDER is the repository, whose pages are Markdown, or with --site the site that ./run docs has made. A link of a page
must lead to a file of the repository, as on GitHub, and its anchor to a heading. Every page is listed in docs/index.md,
which README.md names. Pages that comments of sources name must exist, and so must sources that pages name. Needs the
standard library only.
"""

import html.parser
import os
import pathlib
import re
import sys
import urllib.parse

SOURCES = {".hpp", ".cpp", ".py", ".sh", ".txt", ".cmake"}
NAMED = re.compile(r"`((?:include|molecular|robotics|python|tests|bench|docs|hinge|detail)/[\w/.]+\.(?:hpp|cpp|py))`")
NAMED_FROM = ("", "include", "molecular/include", "robotics/include", "include/hinge")


def without_code(text):
    """Returns Markdown without fenced blocks and comments."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    return re.sub(r"^ *```.*?^ *```$", "", text, flags=re.S | re.M)


def anchors_of_page(text):
    """Returns the anchors that GitHub gives to the headings of a page."""
    anchors = set()
    for heading in re.findall(r"^#{1,6} +(.*?) *#*$", without_code(text), flags=re.M):
        heading = re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", heading)
        anchor = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        number = 0
        while f"{anchor}-{number}" in anchors if number else anchor in anchors:
            number += 1
        anchors.add(f"{anchor}-{number}" if number else anchor)
    return anchors


def links_of_page(text):
    """Returns the targets of links and images."""
    text = re.sub(r"(`+)(?!`).*?(?<!`)\1(?!`)", "", without_code(text), flags=re.S)
    return re.findall(r"\]\(\s*([^)\s]+)[^)]*\)", text) + re.findall(r"^\[[^]]+\]: +(\S+)", text, flags=re.M)


class Page(html.parser.HTMLParser):
    """Links and anchors of an HTML file."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], {""}
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name == "id" or (name == "name" and tag == "a"):
                self.anchors.add(value)
            elif name in ("href", "src") and value is not None:
                self.links.append(value)

    handle_startendtag = handle_starttag


def broken_links(path, links, root, anchors):
    """Returns one sentence per link that leads nowhere. anchors: a function from a path to its anchors, or None."""
    broken = []
    for link in links:
        url = urllib.parse.urlsplit(link)
        if url.scheme or url.netloc:
            continue
        target = path
        if url.path:
            target = pathlib.Path(os.path.normpath(path.parent / urllib.parse.unquote(url.path)))
        shown = f"{path.relative_to(root)}: {link}"
        if url.path.startswith("/") or root not in (target, *target.parents):
            broken.append(f"{shown} leads out of the folder")
        elif not target.exists():
            broken.append(f"{shown} does not exist")
        elif url.fragment and (known := anchors(target)) is not None:
            if urllib.parse.unquote(url.fragment) not in known:
                broken.append(f"{shown}: no such heading")
    return broken


def missing_sources(text, root):
    """Returns the sources that a page names in code, from the root or as an include does, and that do not exist."""
    return [name for name in NAMED.findall(text) if not any((root / folder / name).exists() for folder in NAMED_FROM)]


def check_repository(root):
    """Returns one sentence per broken link, page without a line in the index, and file that is named and missing."""
    pages = {path: path.read_text() for path in [*root.glob("*.md"), *(root / "docs").rglob("*.md")]}

    def anchors(path):
        return anchors_of_page(pages[path]) if path in pages else None

    broken = []
    for path, text in pages.items():
        broken += broken_links(path, links_of_page(text), root, anchors)
        broken += [f"{path.relative_to(root)} names {name}: no such file" for name in missing_sources(text, root)]
    index = root / "docs/index.md"
    listed = {os.path.normpath(index.parent / link.split("#")[0]) for link in links_of_page(pages[index])}
    broken += [
        f"docs/index.md does not list {path.relative_to(root)}"
        for path in pages
        if path != index and str(path) not in listed
    ]
    if "docs/index.md" not in links_of_page(pages[root / "README.md"]):
        broken.append("README.md has no link to docs/index.md")
    for folder in ("include", "molecular", "robotics", "python", "tests", "bench", "docs"):
        for path in (root / folder).rglob("*"):
            if path.suffix in SOURCES and path.is_file():
                for name in set(re.findall(r"\bdocs/[\w/]+\.md\b", path.read_text())):
                    if not (root / name).exists():
                        broken.append(f"{path.relative_to(root)} names {name}, which does not exist")
    return len(pages), broken


def check_site(root):
    """Returns one sentence per broken link of a built site."""
    # The page for wrong addresses is shown at any address, so its links are absolute.
    pages = {path: Page(path.read_text()) for path in root.rglob("*.html") if path != root / "404.html"}

    def anchors(path):
        # Doxygen links to the list of nested classes also where all of them are private, and it writes no list.
        return pages[path].anchors | {"nested-classes"} if path in pages else None

    return len(pages), [
        sentence for path, page in pages.items() for sentence in broken_links(path, page.links, root, anchors)
    ]


def main(arguments):
    is_site = arguments[:1] == ["--site"]
    check = check_site if is_site else check_repository
    number, broken = check(pathlib.Path(arguments[is_site]).resolve())
    print("\n".join(sorted(broken) or [f"links: {number} pages, all links lead to a page and a heading"]))
    return 1 if broken else 0


sys.exit(main(sys.argv[1:]))
