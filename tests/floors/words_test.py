"""words_test.py <project>: does the program read no text that it wrote itself?

Code decides by enumerators and records; sentences are made where they are shown, and nothing looks into them. So a line of
src or apps that compares, searches or cuts a text by a literal must be about a key of a case (the literal has the form of
one, "beam.theory"), or be in a folder or a function that is listed here with its reason. Functions are found by
universal-ctags.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

ALLOWED = {
    "src/io/": "files and their formats",
    "src/case/keys/": "keys as a user writes them, and messages about them",
    "src/case/checks.cpp: check_contact()": "a table of keys",
    "src/case/shifted_case.cpp: why_not_shifted()": "a table of keys",
    "src/case/shifted_case.cpp: shifted_keys()": "a table of keys",
    "src/report/study_columns.h: printed_heading()": "headings have two lines",
    "src/report/text/run_summary.cpp: wrapped()": "breaks lines at blanks",
    "src/report/text/uncertain.cpp: exact_text()": "digits of a number",
    "src/report/text/uncertain.cpp: rounded()": "digits of a number",
    "src/report/text/uncertain.cpp: align()": "puts decimal points under each other",
    "src/report/text/uncertain.cpp: with_decimals()": "digits of a number",
    "src/report/text/uncertain.cpp: with_unit()": "a unit",
    "src/simulate/settings/memory.cpp: free_in_control_groups()": "a file of the system",
    "src/study/sweep.cpp: parse_method_name()": "the value of an option",
    "apps/subimpact/listings.cpp: print_new_case()": "the first line of a file",
    "apps/subimpact/command_line.cpp: unexpected_words()": "an option",
    "apps/subimpact/command_line.cpp: roff()": "the format of manual pages",
    "apps/subimpact/command_line.cpp: print_text()": "the format of manual pages",
    "apps/subimpact/run.cpp: error_bars_of()": "an option",
    "apps/subimpact/run.cpp: run_loaded()": "an option",
    "apps/subimpact/run.cpp: directory_beside()": "the name of a directory",
    "apps/subimpact/run.cpp: next_steps()": "an option",
}

search = re.compile(r"""[=!]=\s*(?:std::string(?:_view)?\()?"(.+?)"|(?:\.r?find|\.(?:starts|ends)_with|\.contains|find_(?:first|last)_of)\(\s*["'](.*?)["']""")
key = re.compile(r"[a-z_]+\.[a-z_.]*")


def hits(line):
    return [literal for pair in search.findall(line.split("//")[0]) for literal in pair if literal and not key.fullmatch(literal)]


project = Path(sys.argv[1])
files = [str(path.relative_to(project)) for top in ("src", "apps") for path in sorted((project / top).rglob("*"))
         if path.suffix in (".h", ".cpp")]
tags = subprocess.run(["ctags", "--output-format=json", "--fields=+ne", "--c++-kinds=f", "-L", "-", "-f", "-"],
                      cwd=project, input="\n".join(files), check=True, capture_output=True, text=True)
functions = {}
for tag in map(json.loads, tags.stdout.splitlines()):
    functions.setdefault(tag["path"], []).append((tag["line"], tag.get("end", tag["line"]), tag["name"]))

read, used = [], set()
for name in files:
    for number, line in enumerate((project / name).read_text().splitlines(), 1):
        if not hits(line):
            continue
        within = [function for first, last, function in functions.get(name, []) if first <= number <= last]
        place = f"{name}: {within[-1]}()" if within else name
        allowed = {entry for entry in ALLOWED if place == entry or entry.endswith("/") and name.startswith(entry)}
        used |= allowed
        if not allowed:
            read.append(f"{place}, line {number}: {line.strip()}")
idle = sorted(set(ALLOWED) - used)
if read or idle:
    sys.exit("\n".join([*(f"a text that the program reads: {place}" for place in read),
                        *(f"an exception that is not needed: {place}" for place in idle)]))
print(f"{len(files)} files, {len(used)} exceptions")
