"""rooms_test.py <project>: do the rooms of each floor include one another in one direction only?

A room is a folder within a floor (src/model/mesh), with its public headers (include/subimpact/model/mesh).
Prints who includes whom; status 1 and the circle if there is one, or if docs/architecture.md lists other folders.
"""

import re
import sys
from collections import defaultdict
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

project = Path(sys.argv[1])
bases = (project / "include/subimpact", project / "src")
includes = re.compile(r'#include "(?:subimpact/)?([a-z_/]+)/[a-z_]+\.h"')


def same_floor(room: str, other: str) -> bool:
    return room.split("/")[0] == other.split("/")[0]


uses: dict[str, set[str]] = defaultdict(set)
for base in bases:
    for path in sorted(base.rglob("*.h")) + sorted(base.rglob("*.cpp")):
        room = path.relative_to(base).parent.as_posix()
        for other in includes.findall(path.read_text()):
            if other != room and "/" in room and "/" in other and same_floor(room, other):
                uses[room].add(other)

try:
    TopologicalSorter(uses).prepare()
except CycleError as circle:
    sys.exit("a circle of rooms: " + " is included by ".join(circle.args[1]))
for room, others in sorted(uses.items()):
    print(f"{room}: {', '.join(sorted(others))}")
if not uses:
    sys.exit("no room includes another: is this the project?")

folders = {path.relative_to(project).as_posix() for path in (project / "src").rglob("*") if path.is_dir()}
listed = set(re.findall(r"^(src/[a-z_/]+)", (project / "docs/architecture.md").read_text(), re.M))
if folders != listed:
    sys.exit("docs/architecture.md lists other folders than src has: " + ", ".join(sorted(folders ^ listed)))
