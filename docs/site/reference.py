"""Pages of the site that are generated: keys, columns and commands from the program, the Python package from
its docstrings, the public headers of C++ from their texts."""

import os
import re
import subprocess
import sys

DECLARED = re.compile(r"(?m)^(?:class|struct|enum class) (\w+)[^;\n]*$|^(?:[\w:<>&*]+ )+[&*]*(\w+)\(")


def escaped(text):
    """Plain text in a page of Markdown, with code between backticks left alone."""
    parts = re.split(r"(`[^`]+`)", text)
    return "".join(part if part.startswith("`") else re.sub(r"([\\*_<>\[\]#|$])", r"\\\1", part) for part in parts)


def printed(program, *arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


def keys(program):
    """A heading per key, from what `subimpact keys` prints."""
    page = ["# Every key\n", "The keys of a case file, as `subimpact keys` lists them; "
            "[the case file](../docs/case-file.md) explains how they go together.\n"]
    table = ""
    for line in printed(program, "keys").splitlines():
        if found := re.fullmatch(r"\[(.+)\]", line):
            table = found[1]
            page.append(f"## `[{table}]`\n")
        elif found := re.match(r"(\w+) +(.*)", line):
            name = f"{table}.{found[1]}" if table else found[1]
            page.append(f"### `{name}`\n\n{escaped(found[2])}\n")
        elif found := re.match(r" {21} *(\S+) {2,}(.*)", line):
            page.append(f"- `{found[1]}`: {escaped(found[2])}")
        elif line.strip():
            page.append(f"*{escaped(line.strip())}*\n")
        elif not line.strip():
            page.append("")
    return "\n".join(page) + "\n"


def columns(program):
    """A heading per table, from what `subimpact columns` prints."""
    page = ["# Every column\n", "The columns of the tables that runs write, as `subimpact columns` lists them; "
            "[tables and files](../docs/files.md) explains them.\n"]
    for line in printed(program, "columns").splitlines():
        if found := re.match(r"([\w./-]+): (.*)", line):
            page += [f"\n## {found[1]}\n\n{escaped(found[2])}\n", "| column | meaning |", "|---|---|"]
        elif found := re.match(r"  (\S+) +(.*)", line):
            page.append(f"| `{found[1]}` | {escaped(found[2])} |")
        elif line.strip():
            page.append(f"\n{escaped(line.strip())}\n")
    return "\n".join(page) + "\n"


def commands(program):
    """A heading per command, with its help."""
    help_text = printed(program, "--help")
    names = re.findall(r"(?m)^  ([a-z][\w-]*) {2,}", help_text.partition("Subcommands:")[2].partition("Examples:")[0])
    page = ["# Commands\n", "What every command prints with `--help`.\n", f"```\n{help_text.rstrip()}\n```\n"]
    for name in names:
        page.append(f"## subimpact {name}\n\n```\n{printed(program, name, '--help').rstrip()}\n```\n")
    return "\n".join(page)


def python_package(python, folder, here):
    """From its docstrings, by a Python that can import it; what is missing is said on the page."""
    environment = dict(os.environ, PYTHONPATH=str(folder), PYTHONDONTWRITEBYTECODE="1")
    done = subprocess.run([python, str(here / "python_api.py")], capture_output=True, text=True, env=environment)
    if done.returncode == 0:
        return done.stdout
    reason = done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "no reason given"
    print(f"Python package left out: {reason}", file=sys.stderr)
    return f"# Python package\n\nNot part of this site: {escaped(reason)}. " \
           "[Populations, from Python](../docs/populations.md) shows its use.\n"


def first_comment(text):
    """The first comment of a header that documents something, as paragraphs."""
    found = re.search(r"(?m)(?:^[ ]*///(?!<).*\n)+", text)
    if not found:
        return ""
    lines = [re.sub(r"^ *///", "", line) for line in found[0].splitlines()]
    code = any(line.startswith("     ") for line in lines)
    lines = [line[1:] if line.startswith(" ") else line for line in lines]
    if not code:
        return escaped("\n".join(lines))
    return "\n".join(line if line.startswith("    ") else escaped(line) for line in lines)


def headers(project):
    """Pages by path: one for each folder of public headers, with a heading and the text of each header."""
    top = project / "include/subimpact"
    pages, listing = {}, []
    for folder in sorted(path for path in top.iterdir() if path.is_dir()):
        page = [f"# {folder.name}/\n", f"Public headers of the floor `{folder.name}/` "
                "([the floors](../../docs/architecture.md#the-floors)); `#include \"subimpact/...\"`.\n"]
        for file in sorted(folder.rglob("*.h")):
            name = file.relative_to(top)
            text = file.read_text()
            comment = first_comment(text)
            page.append(f"## {name}\n\n{comment}\n\n```cpp\n{text.rstrip()}\n```\n")
            anchor = re.sub(r"[^\w-]", "", str(name))
            declared = [f"`{word}`" for word in dict.fromkeys(map(''.join, DECLARED.findall(text)))]
            listing.append(f"| [{name}]({folder.name}.md#{anchor}) | {', '.join(declared)} |")
        pages[f"reference/cpp/{folder.name}.md"] = "\n".join(page)
    pages["reference/cpp/README.md"] = "\n".join([
        "# The public headers\n", "What a program may include; [the library](../../docs/library.md) shows its use.\n",
        "| header | declares |", "|---|---|", *listing, ""])
    return pages
