#!/usr/bin/env python3
"""Draws docs/moving-beam.svg, the README's picture: the published strike as a moving picture.

  docs/moving_beam.py                builds and runs the example, and draws it
  docs/moving_beam.py DIR PICTURE    draws the run in DIR

An SVG file with animations, which browsers play in any page without scripts. Displacements are
measured from the beam's mean and exaggerated as the picture states.
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
WIDTH, HEIGHT, LEFT, MIDDLE, BAR = 800, 300, 30, 150, 262
SECONDS = 14.0  # of the picture, for the whole run
FRAMES = 200
EXAGGERATION = 3


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            yield {name: float(text) if text else None for name, text in row.items() if name not in ("kind", "doubt")}


def shapes(directory):
    """(time, [(position, displacement, plastic curvature), ...]) of every stored shape."""
    found = {}
    for row in rows(directory / "shapes.csv"):
        found.setdefault(row["time_s"], []).append(
            (row["position_m"], row["displacement_m"], row["plastic_curvature_per_m"]))
    return sorted(found.items())


def mean(shape):
    total = sum(0.5 * (b[0] - a[0]) * (a[1] + b[1]) for a, b in zip(shape, shape[1:]))
    return total / (shape[-1][0] - shape[0][0])


def animate(attribute, values, times, end):
    return (f'<animate attributeName="{attribute}" dur="{SECONDS}s" repeatCount="indefinite" '
            f'values="{";".join(values)}" keyTimes="{";".join(f"{t / end:.5g}" for t in times)}"/>')


def picture(directory):
    summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    length = summary["case"]["beam"]["length"]
    history = list(rows(directory / "history.csv"))
    hits = list(rows(directory / "events.csv"))
    end = history[-1]["time_s"]
    stored = shapes(directory)
    step = max(1, len(stored) // FRAMES)
    frames = [stored[0], *stored[step:-1:step], stored[-1]]
    times = [time for time, _ in frames]
    scale = (WIDTH - 2 * LEFT) / length

    def y(displacement, origin):
        return MIDDLE + EXAGGERATION * scale * (displacement - origin)

    def path(shape, points):
        origin = mean(shape)
        return "M" + " ".join(f"{LEFT + scale * shape[i][0]:.0f},{y(shape[i][1], origin):.1f}" for i in points)

    largest = max(abs(p[2]) for _, shape in frames for p in shape)
    whole = range(len(frames[0][1]))
    hinge = [i for i in whole if any(abs(shape[i][2]) > 0.02 * largest for _, shape in frames)]
    striker, row = [], 0
    for time, shape in frames:
        while row + 1 < len(history) and history[row + 1]["time_s"] <= time:
            row += 1
        striker.append(f'{LEFT + 0.5 * (WIDTH - 2 * LEFT):.0f},{y(history[row]["w_m_m"], mean(shape)) - 4:.1f}')
    bar = (WIDTH - 2 * LEFT) / end
    bands = "".join(f'<rect class="hit" x="{LEFT + bar * hit["start_s"]:.2f}" y="{BAR}" height="10" '
                    f'width="{max(0.4, bar * ((hit["end_s"] or end) - hit["start_s"])):.2f}"/>' for hit in hits)
    beam = animate("d", [path(shape, whole) for _, shape in frames], times, end)
    plastic = animate("d", [path(shape, hinge) for _, shape in frames], times, end) if hinge else ""
    yields = summary["first_yield"]["section_s"] or end
    return f'''<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="14">
<title>A rigid mass strikes a free beam: {len(hits)} sub-impacts in {1e3 * end:g} ms</title>
<style>
text {{ fill: #333 }} .beam {{ fill: none; stroke: #6f8593; stroke-width: 9; stroke-linejoin: round }}
.hinge {{ fill: none; stroke: #d55e00; stroke-width: 9; stroke-linejoin: round }} .striker {{ fill: #0072b2 }}
.bar {{ fill: #ddd }} .hit {{ fill: #e69f00 }} .now {{ stroke: #000; stroke-width: 2 }}
@media (prefers-color-scheme: dark) {{ text {{ fill: #ccc }} .bar {{ fill: #444 }} .now {{ stroke: #fff }} .striker {{ fill: #56b4e9 }} }}
</style>
<path class="beam" d="{path(frames[0][1], whole)}">{beam}</path>
<path class="hinge" d="" opacity="0">{plastic}<animate attributeName="opacity" dur="{SECONDS}s" repeatCount="indefinite" values="0;1" keyTimes="0;{yields / end:.5g}" calcMode="discrete"/></path>
<g><path class="striker" d="M-9,-9a9,9 0 0 0 18,0v-45h-18z"/><animateTransform attributeName="transform" type="translate" dur="{SECONDS}s" repeatCount="indefinite" values="{";".join(striker)}" keyTimes="{";".join(f"{t / end:.5g}" for t in times)}"/></g>
<rect class="bar" x="{LEFT}" y="{BAR}" width="{WIDTH - 2 * LEFT}" height="10"/>{bands}
<line class="now" x1="{LEFT}" x2="{LEFT}" y1="{BAR - 4}" y2="{BAR + 14}"><animateTransform attributeName="transform" type="translate" dur="{SECONDS}s" repeatCount="indefinite" from="0,0" to="{WIDTH - 2 * LEFT},0"/></line>
<text x="{LEFT}" y="{HEIGHT - 8}">0</text><text x="{WIDTH - LEFT}" y="{HEIGHT - 8}" text-anchor="end">{1e3 * end:g} ms</text>
<text x="{WIDTH / 2}" y="{HEIGHT - 8}" text-anchor="middle">{len(hits)} sub-impacts; displacement from the beam's mean ×{EXAGGERATION}; orange: yielded</text>
</svg>
'''


def main():
    if len(sys.argv) == 3:
        pathlib.Path(sys.argv[2]).write_text(picture(pathlib.Path(sys.argv[1])), encoding="utf-8")
        return
    if len(sys.argv) != 1:
        print(__doc__)
        sys.exit(0 if "--help" in sys.argv else 2)
    setup = f'source "{ROOT}/scripts/setup.sh" && build release subimpact'
    subprocess.run(["bash", "-c", setup], check=True)
    with tempfile.TemporaryDirectory() as directory:
        subprocess.run([ROOT / "build/release/bin/subimpact", "run", ROOT / "validation/physics/paper/case.toml",
                        "--out", directory, "--error-bars=off", "--quiet"], check=True)
        target = ROOT / "docs/moving-beam.svg"
        target.write_text(picture(pathlib.Path(directory)), encoding="utf-8")
        print(f"{target}: {target.stat().st_size / 1e3:.0f} kB")


main()
