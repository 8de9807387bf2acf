# SPDX-License-Identifier: BSD-3-Clause
"""Measures the trade between speed and accuracy on five molecules and five robots with biocd dial and robocd dial.

The tools are biocd_fcl and robocd_fcl, which show FCL in the tables of extremes. Usage: tradeoffs.py FOLDER_OF_TOOLS
[SECONDS_A_MODEL] [--page]. Prints Markdown; --page writes it into docs/explanation/tradeoffs.md, between the page's
markers, and draws docs/images/tradeoffs.svg. Robots and molecules of the shared data are left out with a message where it
is absent.
"""
import json
import math
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared" / "data"
PAGE = ROOT / "docs" / "explanation" / "tradeoffs.md"
PICTURE = ROOT / "docs" / "images" / "tradeoffs.svg"
BEGIN, END = "<!-- begin measured -->\n", "<!-- end measured -->"


def models():
    """Yields (name, tool, arguments) of the models whose files are there."""
    molecules = SHARED / "molecules" / "paper"
    wanted = [
        ("1UBQ, tail of 7 residues", [ROOT / "molecular/data/1ubq.pdb", "--free", "A:70-76"]),
        ("1VII, all residues", [molecules / "1vii_3frames.pdb"]),
        ("2AXD with hydrogens, all residues", [molecules / "2axd.pdb.gz"]),
        ("1MBN, 10 residues", [molecules / "1mbn.pdb", "--free", "count:10"]),
        ("1BE0, 10 residues", [molecules / "1be0.cif", "--free", "count:10"]),
    ]
    for name, (file, *words) in wanted:
        yield name, "biocd", [file, *words, "--exempt-reference"]
    yield "arm", "robocd", [ROOT / "robotics/data/arm.urdf", "--srdf", ROOT / "robotics/data/arm.srdf"]
    for name in ("panda", "ur5_robotiq", "talos", "pr2"):
        folder = SHARED / "robots" / name
        yield name, "robocd", [folder / f"{name}.urdf", "--srdf", folder / f"{name}.srdf"]


def measure(tools, tool, arguments, seconds):
    command = [str(Path(tools) / f"{tool}_fcl"), "dial", *map(str, arguments), "--time", str(seconds), "--seed", "1", "--json",
               "--extremes"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit status {done.returncode}\n{done.stderr}")
    return json.loads(done.stdout)


def two_digits(number):
    return "0" if number == 0 else f"{number:.{max(0, min(9, 1 - math.floor(math.log10(abs(number)))))}f}"


def rate(row, word):
    value, interval = row[f"{word}_rate"], row[f"{word}_interval"]
    if value is None:
        return "-"
    if value == 0:
        return f"0 (< {two_digits(100 * interval[1])} %)"
    return f"{two_digits(100 * value)} %"


def time(seconds):
    for size, unit in ((1, "s"), (1e-3, "ms"), (1e-6, "us"), (1e-9, "ns")):
        if seconds >= size * 0.9995:
            value = seconds / size
            return f"{value:.{0 if value >= 99.95 else 1 if value >= 9.995 else 2}f} {unit}"
    return "0"


def table(section):
    lines = [f"| {section['title'].lower()} | time | speed | false accepts | false rejects |", "|---|---|---|---|---|"]
    for row in section["rows"]:
        is_reference = row is section["rows"][0]
        exact = row["sound"] == "exact" and row["false_accepts"] + row["false_rejects"] == 0
        accepts = ("reference" if is_reference else "exact" if exact else
                   "none, encloses" if row["sound"] == "no false accept" and row["false_accepts"] == 0 else
                   rate(row, "false_accept"))
        rejects = "" if is_reference or exact else rate(row, "false_reject")
        name = f"**{row['name']}**" if row["front"] else row["name"]
        lines.append(f"| {name} | {time(row['seconds'])} | {row['speed']:.2f} | {accepts} | {rejects} |")
    first = section["rows"][0]
    share = 100 * first["colliding"] / max(1, first["colliding"] + first["free"])
    words = f"{first['count']} {section['unit'][1]}, {section['population']}; {two_digits(share)} % collide."
    return "\n".join([words, "", *lines, ""])


def extremes_table(extremes):
    lines = ["| " + " | ".join(extremes["columns"]) + " |", "|" + "---|" * len(extremes["columns"])]
    lines += ["| " + " | ".join(row) + " |" for row in extremes["rows"]]
    return "\n".join(lines) + "\n"


def processor():
    for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            return line.split(": ", 1)[1]
    return "unknown"


def page_text(results, tools, seconds):
    version = subprocess.run([str(Path(tools) / "robocd_fcl"), "--version"], capture_output=True, text=True, check=True)
    flags = "-O3 -march=native"
    text = [f"Machine: {processor()}, {os.cpu_count()} shared cores; {version.stdout.strip()}, {flags}. Seed 1, "
            f"{seconds:g} s for each model. Command: `./run bench tradeoffs -- {seconds:g} --page`. "
            "Choices in bold are on the Pareto front.\n"]
    text.append("### Recommendations\n")
    text.append("| model | recommendation | checked on fresh questions |\n|---|---|---|")
    for name, result in results:
        advice = result["recommendation"]
        check = advice["check"]
        words = advice["text"].split("; no other choice")[0]
        fresh = "-" if check is None else (f"{check['speed']:.2f} times faster, {check['false_accepts']} false accepts in "
                                           f"{check['colliding']}, {check['false_rejects']} false rejects in "
                                           f"{check['free']}")
        text.append(f"| {name} | {words} | {fresh} |")
    text.append("\n### What the scenes do not require\n")
    for name, result in results:
        for requirement in result["requires"]:
            text.append(f"* {name}: {requirement['text']}")
    for name, result in results:
        text.append(f"\n### {name}\n")
        text += [table(section) for section in result["sections"]]
    for wanted in ("arm", "1UBQ, tail of 7 residues"):
        for name, result in results:
            if name == wanted:
                text.append(f"### Extremes: {name}\n\n{extremes_table(result['extremes'])}")
    return "\n".join(text)


def picture(results):
    """Returns an SVG with one panel for each model: time against the share of wrong verdicts."""
    columns, width, height, left, top = 5, 250, 210, 52, 34
    panels = []
    for n, (name, result) in enumerate(results):
        rows = [row for row in result["sections"][0]["rows"] if row["kind"] != "engine"]  # far slower than the others
        x0, y0 = (n % columns) * width + left, (n // columns) * height + top
        inner, tall, zero = width - left - 18, height - top - 46, 22
        times = [row["seconds"] for row in rows]
        low, high = math.log10(min(times)) - 0.1, math.log10(max(times)) + 0.1
        def place(row):
            x = x0 + (math.log10(row["seconds"]) - low) / (high - low) * inner
            wrong = row["wrong_rate"] or 0
            y = y0 + tall - zero / 2 if wrong == 0 else y0 + (tall - zero) * min(1, -math.log10(wrong) / 5)
            return x, y
        parts = [f'<text x="{x0 - left + 8}" y="{y0 - 14}" font-weight="bold">{name}</text>']
        for power in range(0, 6):
            y = y0 + (tall - zero) * power / 5
            label = {0: "100 %", 1: "10 %", 2: "1 %", 3: "0.1 %", 4: "0.01 %", 5: "0.001 %"}[power]
            parts.append(f'<line x1="{x0}" x2="{x0 + inner}" y1="{y:.1f}" y2="{y:.1f}" stroke="#d9dee6"/>')
            parts.append(f'<text x="{x0 - 4}" y="{y + 4:.1f}" text-anchor="end" fill="#566273" font-size="9">{label}</text>')
        parts.append(f'<rect x="{x0}" y="{y0 + tall - zero}" width="{inner}" height="{zero}" fill="#eef1f5"/>')
        parts.append(f'<text x="{x0 - 4}" y="{y0 + tall - zero / 2 + 4}" text-anchor="end" fill="#566273" '
                     'font-size="9">none</text>')
        for mark in (f * 10.0 ** power for power in range(-9, 0) for f in (1, 2, 5)):
            if not low <= math.log10(mark) <= high:
                continue
            x = x0 + (math.log10(mark) - low) / (high - low) * inner
            parts.append(f'<text x="{x:.1f}" y="{y0 + tall + 14}" text-anchor="middle" fill="#566273" font-size="9">'
                         f'{time(mark).replace(".00", "").replace(".0", "")}</text>')
        front = sorted((row for row in rows if row["front"]), key=lambda row: row["seconds"])
        steps = "".join(f"M{x:.1f} {y:.1f}" if k == 0 else f"H{x:.1f}V{y:.1f}"
                        for k, (x, y) in enumerate(map(place, front)))
        parts.append(f'<path d="{steps}" fill="none" stroke="#1f5fbf" stroke-dasharray="4 3"/>')
        for row in rows[1:] + rows[:1]:  # the reference on top
            x, y = place(row)
            is_reference = row is rows[0]
            colour = "#b3125f" if is_reference else "#1f5fbf" if row["front"] else "white"
            edge = "#b3125f" if is_reference else "#1f5fbf" if row["front"] else "#566273"
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{5 if is_reference else 4}" fill="{colour}" '
                         f'stroke="{edge}" stroke-width="1.5">'
                         f'<title>{row["name"]}: {time(row["seconds"])}</title></circle>')
        panels.append("\n".join(parts))
    lines = math.ceil(len(results) / columns)
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {columns * width} {lines * height + 24}" '
            f'font-family="sans-serif" font-size="11">\n<rect width="100%" height="100%" fill="white"/>')
    legend = (f'<text x="8" y="{lines * height + 16}" fill="#566273">time of a question (logarithmic) against the share of '
              'wrong verdicts; red: the reference; blue: no other choice is faster and wrong less often; '
              'the engines lazy and brute, far slower, are left out</text>')
    return "\n".join([head, *panels, legend, "</svg>\n"])


def main():
    words = [word for word in sys.argv[1:] if word != "--page"]
    tools, seconds = words[0], float(words[1]) if len(words) > 1 else 60.0
    results = []
    for name, tool, arguments in models():
        if not Path(arguments[0]).exists():
            print(f"{name}: left out, the shared data is missing", file=sys.stderr)
            continue
        print(f"{name} ...", file=sys.stderr)
        results.append((name, measure(tools, tool, arguments, seconds)))
    text = page_text(results, tools, seconds)
    print(text)
    if "--page" in sys.argv:
        page = PAGE.read_text(encoding="utf-8")
        begin, end = page.index(BEGIN) + len(BEGIN), page.index(END)
        PAGE.write_text(page[:begin] + "\n" + text + "\n" + page[end:], encoding="utf-8")
        PICTURE.write_text(picture(results), encoding="utf-8")


if __name__ == "__main__":
    main()
