# SPDX-License-Identifier: BSD-3-Clause
"""Makes docs/reference/python.md from the docstrings: PYTHONPATH=build/python /usr/bin/python3 reference_page.py."""

import inspect
import pathlib

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/reference/python.md"
HEAD = """# Python

Made from the docstrings by `python/tests/reference_page.py`; the tests check that it is up to date. `help()` shows the
same text.
"""


def _block(text):
    return f"\n```text\n{text.rstrip()}\n```\n"


def _signature(thing):
    return str(inspect.signature(thing)).replace("(self, ", "(").replace("(self)", "()")


def _entry(name, thing):
    """The signature and docstring of a function, or the docstring of a property."""
    if isinstance(thing, classmethod):
        thing = thing.__func__
        head = name + str(inspect.signature(thing)).replace("(cls, ", "(")
    else:
        head = name + (_signature(thing) if callable(thing) else "")
    return head + "\n" + "\n".join("    " + line if line else "" for line in inspect.getdoc(thing).splitlines())


def _class(thing):
    text = f"\n### {thing.__module__}.{thing.__name__}\n" + _block(
        ("" if issubclass(thing, Exception) else thing.__name__ + _signature(thing.__init__) + "\n\n")
        + inspect.getdoc(thing)
    )
    if issubclass(thing, Exception):
        return text
    members = [(name, inspect.getattr_static(thing, name)) for name in sorted(dir(thing)) if not name.startswith("_")]
    described = [_entry(name, m) for name, m in members if callable(m) or hasattr(m, "__get__")]
    return text + (_block("\n\n".join(described)) if described else "")


def page(modules):
    """The text of the page."""
    text = HEAD
    for module in modules:
        if not module.__all__:
            continue
        text += f"\n## {module.__name__}\n" + _block(inspect.getdoc(module))
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isclass(thing):
                text += _class(thing)
            elif callable(thing):
                text += f"\n### {module.__name__}.{name}\n" + _block(_entry(name, thing))
    return text


if __name__ == "__main__":
    import hinge
    import hinge.distributed
    import hinge.molecular
    import hinge.robotics

    PAGE.write_text(page([hinge, hinge.molecular, hinge.robotics, hinge.distributed]))
