"""rooms_test.py <project>: do rooms of a floor, and modules of the Python package, use one another in one direction only?

A room is a folder within a floor (src/model/mesh), with its public headers (include/subimpact/model/mesh). Modules use one
another wherever they import: at their beginning, in a function, for types alone. A method that is short for a function of
a higher module (case.run) finds it by name when it is called.
Prints who uses whom; status 1 and the circle if there is one, or if docs/architecture.md lists other folders.
"""

import ast
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

modules = {path.relative_to(project / "python"): path for path in (project / "python/subimpact").rglob("*.py")}
names = {".".join(path.with_suffix("").parts).removesuffix(".__init__") for path in modules}
imports: dict[str, set[str]] = defaultdict(set)
for relative, path in modules.items():
    name = ".".join(relative.with_suffix("").parts)
    package = name.rsplit(".", 1)[0].split(".")
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = ".".join([*package[:len(package) - node.level + 1], *filter(None, [node.module])])
            used = {f"{base}.{alias.name}" if f"{base}.{alias.name}" in names else base for alias in node.names
                    if f"{base}.{alias.name}" != "subimpact._core"}
            imports[name.removesuffix(".__init__")] |= used - {name.removesuffix(".__init__")}

for kind, graph in ("rooms", uses), ("modules", imports):
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as circle:
        sys.exit(f"a circle of {kind}: " + " is used by ".join(circle.args[1]))
    for user, others in sorted(graph.items()):
        print(f"{user}: {', '.join(sorted(others))}")
    if not graph:
        sys.exit(f"no {kind} use others: is this the project?")

folders = {path.relative_to(project).as_posix() for path in (project / "src").rglob("*") if path.is_dir()}
listed = set(re.findall(r"^(src/[a-z_/]+)", (project / "docs/architecture.md").read_text(), re.M))
if folders != listed:
    sys.exit("docs/architecture.md lists other folders than src has: " + ", ".join(sorted(folders ^ listed)))
