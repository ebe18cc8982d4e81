"""Prints the page of the Python package, from its signatures and docstrings."""

import dataclasses
import importlib
import inspect
import pkgutil
import re

import subimpact


def signature(thing):
    try:
        return str(inspect.signature(thing)).replace("'", "").replace("self, ", "").replace("(self)", "()")
    except (TypeError, ValueError):
        return ""


def docs(thing):
    text = inspect.getdoc(thing) or ""
    text = text.replace("<", "&lt;").replace(">", "&gt;")
    return re.sub(r"\bdocs/([\w-]+)\.md", r"[docs/\1.md](../docs/\1.md)", text)


def own_docs(owner):
    """The docstring, if it is the class's own and not made by Python."""
    text = docs(owner)
    return "" if text.startswith(f"{owner.__name__}(") or owner.__doc__ is None else text


def members(owner):
    """Methods and properties that a class defines itself and that do not begin with an underscore."""
    for name, member in vars(owner).items():
        if name.startswith("_"):
            continue
        if isinstance(member, property):
            yield f"### {owner.__name__}.{name}\n\n{docs(member)}\n"
        elif isinstance(member, (classmethod, staticmethod)) or inspect.isfunction(member):
            function = getattr(owner, name)
            yield f"### {owner.__name__}.{name}\n\n```python\n{name}{signature(function)}\n```\n\n{docs(function)}\n"


def entry(name, thing):
    if inspect.isclass(thing):
        parts = [f"## {name}\n"]
        if issubclass(thing, Exception):
            parts.append(f"An exception ({thing.__mro__[1].__name__}).\n")
        elif dataclasses.is_dataclass(thing):
            parts.append("Fields: " + ", ".join(f"`{field.name}`" for field in dataclasses.fields(thing)) + ".\n")
        else:
            parts.append(f"```python\n{name}{signature(thing)}\n```\n")
        return "\n".join([*parts, own_docs(thing) + "\n", *members(thing)])
    if callable(thing):
        return f"## {name}\n\n```python\n{name}{signature(thing)}\n```\n\n{docs(thing)}\n"
    return f"## {name}\n\nA {type(thing).__name__}.\n"


def subpackages():
    """What packages within the package offer beside what it offers itself."""
    for module in pkgutil.iter_modules(subimpact.__path__):
        if not module.ispkg or module.name.startswith("_"):
            continue
        try:
            package = importlib.import_module(f"subimpact.{module.name}")
        except ImportError as error:
            yield f"## subimpact.{module.name}\n\nNot listed here: {error}.\n"
            continue
        yield f"## subimpact.{module.name}\n\n{docs(package)}\n"
        for name in package.__all__:
            if name not in subimpact.__all__:
                yield entry(f"{module.name}.{name}", getattr(package, name))


def main():
    print("# Python package\n")
    print(docs(subimpact), "\n")
    for name in subimpact.__all__:
        if not name.startswith("_"):
            print(entry(name, getattr(subimpact, name)))
    for text in subpackages():
        print(text)


main()
