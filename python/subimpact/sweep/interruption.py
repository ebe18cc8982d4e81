"""Signals that end a sweep: what it has is stored first."""

from __future__ import annotations

import signal
import threading
from types import FrameType
from typing import Any


class Interrupted(KeyboardInterrupt):
    """A sweep was ended by a signal; its rows are stored and in the tables."""

    def __init__(self, number: int) -> None:
        super().__init__(f"ended by {signal.Signals(number).name}")
        self.signal = number


class Interruption:
    """Makes SIGTERM and SIGHUP act like Ctrl-C while it is entered, in the main thread, unless the process handles or ignores them
    itself. Raises Interrupted at its end. While a first signal is obeyed, others are not. After `hold` all wait for the end."""

    def __init__(self) -> None:
        self._before: dict[int, Any] = {}
        self._caught: int | None = None
        self._is_held = False

    def hold(self) -> None:
        """From here on results are saved, which no signal is to end."""
        self._is_held = True

    def _stop(self, number: int, _: FrameType | None) -> None:
        if self._caught is None:
            self._caught = number
            if not self._is_held:
                raise KeyboardInterrupt

    def __enter__(self) -> Interruption:
        if threading.current_thread() is threading.main_thread():
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                before = signal.getsignal(number)
                if before in (signal.SIG_DFL, signal.default_int_handler):
                    self._before[number] = before
                    signal.signal(number, self._stop)
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self.hold()
        for number, before in self._before.items():
            signal.signal(number, before)
        if self._caught is not None and (kind is None or issubclass(kind, KeyboardInterrupt)):
            raise Interrupted(self._caught) from None
