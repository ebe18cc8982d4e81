"""lengths.py <project>: are files, functions and folders short enough to hold in the head?

Prints the longest of each, the lines of src, include and apps, and those of all that is installed; status 1 and what is
too long. Limits of the two sums: limits.json. Functions are measured by universal-ctags.
"""

import json
import subprocess
import sys
from pathlib import Path

FILE, FUNCTION, FOLDER, SCRIPTS = 450, 60, 18, 13
# No part of an installation; of python/, bindings and the rest of the build counted beyond what they had.
BESIDE = (".ci/", "benchmarks/", "cmake/", "docs/", "examples/", "fuzz/", "scripts/", "tests/", "validation/")
PYTHON_BESIDE_PACKAGE = 1269

EXCEPTIONS = {
    "src/case/keys/case_keys.cpp: make_case_keys()": "a table: one row a key",
    "src/io/records/run_record.cpp: make_run_record()": "a table: one row a field",
    "src/simulate/settings/methods.cpp: make_descriptors()": "a table: one entry a method",
    "src/integrate/nystrom.cpp: dprkn12()": "a table: the coefficients of seventeen stages",
    "benchmarks/naive_central_difference.cpp: naive_central_difference()": "the naive program, whole",
}

project = Path(sys.argv[1])
tracked = subprocess.run(["git", "ls-files"], cwd=project, check=True, capture_output=True,
                         text=True).stdout.split("\n")
files = [name for name in tracked if name and (project / name).is_file()]
sources = [name for name in files if name.endswith((".h", ".cpp"))]
lines = {name: (project / name).read_bytes().count(b"\n") for name in files
         if name in sources or "/" in name and not name.startswith(BESIDE)}
too_long = []


def judge(kind, lengths, limit):
    for name, length in lengths.items():
        if length > limit and name not in EXCEPTIONS:
            too_long.append(f"{name}: {length} {kind}, more than {limit}")
    longest = max((name for name in lengths if name not in EXCEPTIONS), key=lengths.__getitem__)
    print(f"most {kind}: {lengths[longest]} in {longest}")


def functions():
    tags = subprocess.run(["ctags", "--output-format=json", "--fields=+ne", "--c++-kinds=f", "-L", "-", "-f", "-"],
                          cwd=project, input="\n".join(sources), check=True, capture_output=True, text=True)
    for tag in map(json.loads, tags.stdout.splitlines()):
        if tag.get("kind") == "function" and "end" in tag:
            yield f"{tag['path']}: {tag['name']}()", tag["end"] - tag["line"] + 1


def entries():
    for top in ("src", "include"):
        for folder in [project / top, *(path for path in (project / top).rglob("*") if path.is_dir())]:
            yield str(folder.relative_to(project)), len(list(folder.iterdir()))


judge("lines of a file", {name: lines[name] for name in sources}, FILE)
judge("lines of a function", dict(functions()), FUNCTION)
judge("entries in a folder", dict(entries()), FOLDER)
judge("files in scripts", {"scripts": sum(name.startswith("scripts/") for name in files)}, SCRIPTS)
limits = json.loads((Path(__file__).parent / "limits.json").read_text())
installed = {name: n for name, n in lines.items() if not name.startswith(BESIDE)}
package = sum(n for name, n in installed.items() if name.startswith("python/subimpact/"))
python = sum(n for name, n in installed.items() if name.startswith("python/")) - package
sums = {"src, include, apps": sum(n for name, n in installed.items() if name.startswith(("src/", "include/", "apps/")))}
sums["all that is installed"] = sum(installed.values()) - python + max(0, python - PYTHON_BESIDE_PACKAGE)
for name, n in sums.items():
    print(f"lines of {name}: {n} (at most {limits[name]})")
    if n > limits[name]:
        too_long.append(f"{name}: {n} lines, more than {limits[name]}")
if too_long:
    sys.exit("\n".join(too_long))
