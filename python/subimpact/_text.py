"""Texts from outside: read within bounds, and fit to be stored and printed."""

from __future__ import annotations

import os
import re
import sys

#: Bytes of a case or a plan.
MOST_BYTES = 1_000_000

_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff]")


def printable(text: str) -> str:
    """The text with its control characters, but line breaks and tabs, as "\\x1b": a terminal obeys
    none of it. The program `subimpact` prints texts alike."""
    return _CONTROL.sub(_escaped, text)


def _escaped(character: re.Match[str]) -> str:
    is_byte = "\udc80" <= character.group() <= "\udcff"
    content = character.group().encode("utf-8", "surrogateescape" if is_byte else "surrogatepass")
    return "".join(f"\\x{byte:02x}" for byte in content)


def one_line(text: str) -> str:
    """The text without any control character: spaces for line breaks and tabs."""
    return printable(re.sub(r"[\n\r\t]", " ", text))


def say(text: str) -> None:
    """A message on stderr, which may be gone with its terminal."""
    try:
        print(printable(text), file=sys.stderr)
    except OSError:
        pass


def show(text: str) -> bool:
    """Whether stdout takes the text; a reader who has left needs none."""
    try:
        print(text, end="", flush=True)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # for what is flushed at the end
        if not isinstance(error, BrokenPipeError):
            say(f"subimpact: standard output cannot be written ({error.strerror}); free the disk or write the output elsewhere")
            return False
    return True


def is_unicode(text: str) -> bool:
    """Whether the text can be written as UTF-8: it has no lone surrogates."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def path_text(path: str | os.PathLike[str], kind: type[Exception]) -> str:
    """A path as a text. Raises `kind` for what the library cannot take."""
    text = os.fsdecode(path)
    if "\0" in text or not is_unicode(text):
        raise kind(f"{printable(text)}: is no path; allowed: UTF-8 text without NUL; choose another name")
    return text


def read_at_most(path: str | os.PathLike[str], most: int = MOST_BYTES) -> bytes:
    """The content of a file, or its first `most` + 1 bytes: a device may never end. Raises OSError,
    also for a path with NUL."""
    try:
        with open(path, "rb") as file:
            return file.read(most + 1)
    except ValueError as error:
        raise OSError(0, str(error)) from None


def read_text(path: str | os.PathLike[str], what: str, kind: type[Exception], name: str = "") -> str:
    """The text of a file of at most MOST_BYTES, `what` it is to be. Raises `kind`; a message begins with `name`."""
    try:
        content = read_at_most(path)
    except IsADirectoryError:
        raise kind(f"{name}is a directory; give the path of {what} (TOML)") from None
    except OSError as error:
        raise kind(f"{name}cannot be read ({error.strerror}); give the path of {what} (TOML)") from None
    if len(content) > MOST_BYTES:
        raise kind(f"{name}is larger than {MOST_BYTES} bytes; allowed: {what} (TOML), which has some 1000; give the path of one")
    try:
        return content.decode()
    except UnicodeDecodeError:
        raise kind(f"{name}is no UTF-8 text; allowed: {what} (TOML)") from None
