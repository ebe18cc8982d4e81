"""Hands chunks of cases out to the workers of an executor, in the sense of `concurrent.futures`, and takes their rows back. If a
worker dies, every case that was in the hands of its engine is run again alone; one that ends its worker three times is a row
with the outcome "crashed"."""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import resource
import select
import signal
import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from typing import Any

from .plan import Plan
from .worker import Row, identity_of, row_without_result, run_chunk

MOST_DEATHS = 3
_MOST_IN_A_CHUNK = 2000
_SECONDS_TO_END = 10.0  # for the thread of a pool whose workers are dead
_ROOM_FOR_A_CASE = 0.25  # GiB
_CHUNKS_AHEAD = 3  # per worker, handed out beyond what it runs

#: Takes rows by the numbers of their cases.
Sink = Callable[[dict[int, Row]], None]


def n_cores() -> int:
    """The cores that this process may use."""
    return len(os.sched_getaffinity(0))


def _prepare_worker(parent: int, memory: float | None) -> None:
    """A worker ends with its coordinator, and leaves Ctrl-C and the end of a terminal to it."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG
    if os.getppid() != parent:
        os._exit(1)
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    for number in (signal.SIGALRM, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)
    if memory is not None:
        limit = int(memory * 2**30)
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        limit = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def least_memory() -> float:
    """GiB of address space that a worker must have: what this process has, of which it is a copy,
    and room for a small case."""
    with open("/proc/self/statm", encoding="ascii") as file:
        n_pages = int(file.read().split()[0])
    return n_pages * resource.getpagesize() / 2**30 + _ROOM_FOR_A_CASE


class Processes:
    """Worker processes on this machine."""

    seconds_per_chunk = 0.25
    deaths_per_failure = 1

    def __init__(self, n: int, memory: float | None) -> None:
        self.n_workers = n
        self._memory = memory
        self._start()

    def _start(self) -> None:
        self._pool: Any = ProcessPoolExecutor(
            self.n_workers,
            multiprocessing.get_context("fork"),
            _prepare_worker,
            (os.getpid(), self._memory),
        )
        self._tasks = os.dup(self._pool._call_queue._reader.fileno())  # the pool closes its own when it likes

    def submit(self, plan: Plan, numbers: list[int]) -> Future[Any]:
        return self._pool.submit(run_chunk, plan, numbers)

    def restart(self) -> None:
        self.stop()
        self._start()

    def stop(self) -> None:
        """Ends the workers, whatever they do. The pool's thread then waits for ever where a killed
        worker leaves it: in a write to a full pipe that nobody reads (Python's issue 94777), and in
        the midst of a result. So the pipe is read here, and the end of results is closed."""
        processes = list((self._pool._processes or {}).values())
        thread: threading.Thread | None = getattr(self._pool, "_executor_manager_thread", None)
        results: Any = getattr(self._pool, "_result_queue", None)
        self._pool.shutdown(wait=False, cancel_futures=True)
        for process in processes:
            process.kill()
        if results is not None:
            results._writer.close()
        deadline = time.monotonic() + _SECONDS_TO_END
        while thread is not None and thread.is_alive() and self._tasks >= 0 and time.monotonic() < deadline:
            if select.select([self._tasks], [], [], 0.01)[0]:
                os.read(self._tasks, 2**16)
        tasks, self._tasks = self._tasks, -1
        if tasks >= 0:  # unless Ctrl-C came into an end before
            os.close(tasks)


class CallersExecutor:
    """An executor that the caller has: of Dask, of mpi4py, of any other library."""

    seconds_per_chunk = 2.0
    deaths_per_failure = MOST_DEATHS  # an engine reports a task after it has tried it again itself

    def __init__(self, executor: Any) -> None:
        self._executor: Executor = executor
        self.n_workers = 64
        if hasattr(executor, "get_executor"):  # a client of Dask
            self.n_workers = max(1, sum(executor.nthreads().values()))
            self._executor = executor.get_executor(pure=False)
        for name in ("num_workers", "_max_workers"):
            number = getattr(executor, name, None)
            if isinstance(number, int) and number > 0:
                self.n_workers = number
                break

    def submit(self, plan: Plan, numbers: list[int]) -> Future[Any]:
        return self._executor.submit(run_chunk, plan, numbers)

    def restart(self) -> None:
        """The library does it."""

    def stop(self) -> None:
        """The caller does it."""


def _is_death(error: BaseException) -> bool:
    """Whether a worker was lost, as each library reports it, or could not even begin."""
    return isinstance(error, (BrokenExecutor, MemoryError)) or type(error).__name__ in ("KilledWorker", "CommClosedError")


class Coordinator:
    """Gives chunks of cases to an engine until each case has a row."""

    def __init__(self, engine: Processes | CallersExecutor, plan: Plan, sink: Sink) -> None:
        self._engine = engine
        self._plan = plan
        self._sink = sink
        self._futures: dict[Future[Any], list[int]] = {}
        self._waiting: deque[int] = deque()
        self._suspects: deque[int] = deque()  # to be run alone
        self._deaths: Counter[int] = Counter()
        self._seconds = 0.0
        self._n_timed = 0
        self._is_alone = False

    def run(self, numbers: Iterable[int]) -> None:
        self._waiting.extend(numbers)
        try:
            while self._waiting or self._suspects or self._futures:
                self._hand_out()
                done, _ = wait(self._futures, timeout=1.0, return_when=FIRST_COMPLETED)
                self._take(done)
        finally:
            self._engine.stop()

    def _chunk_size(self) -> int:
        if self._n_timed == 0:
            return 1
        wanted = int(self._engine.seconds_per_chunk * self._n_timed / max(self._seconds, 1e-9))
        fair = len(self._waiting) // (2 * self._engine.n_workers)  # the last ones end together
        return max(1, min(wanted, fair, _MOST_IN_A_CHUNK))

    def _hand_out(self) -> None:
        if self._is_alone and self._futures:
            return
        self._is_alone = bool(self._suspects) and not self._futures
        if self._is_alone:
            self._submit([self._suspects.popleft()], self._suspects)
        if self._suspects or self._is_alone:
            return
        while self._waiting and len(self._futures) < (1 + _CHUNKS_AHEAD) * self._engine.n_workers:
            size = min(self._chunk_size(), len(self._waiting))
            numbers = [self._waiting.popleft() for _ in range(size)]
            if not self._submit(numbers, self._waiting):
                return

    def _submit(self, numbers: list[int], source: deque[int]) -> bool:
        try:
            self._futures[self._engine.submit(self._plan, numbers)] = numbers
            return True
        except BrokenExecutor:  # a worker died meanwhile: these cases were not in its hands
            source.extendleft(reversed(numbers))
            if not self._futures:
                self._engine.restart()
            return False

    def _take(self, done: Iterable[Future[Any]]) -> None:
        rows: dict[int, Row] = {}
        for future in done:
            numbers = self._futures.pop(future)
            error = future.exception()
            if error is None:
                chunk, seconds = future.result()
                rows.update(zip(numbers, chunk))
                self._seconds += seconds
                self._n_timed += len(numbers)
            elif _is_death(error):  # as all tasks of a broken pool end: they are run again
                rows.update(self._blame(numbers))
            else:
                raise error
        if rows:
            self._sink(rows)

    def _blame(self, numbers: list[int]) -> dict[int, Row]:
        if self._is_alone:
            number = numbers[0]
            self._deaths[number] += self._engine.deaths_per_failure
            if self._deaths[number] >= MOST_DEATHS:
                message = f"ended its worker {MOST_DEATHS} times"
                return {number: row_without_result(identity_of(self._plan, number), "crashed", message)}
        self._suspects.extend(numbers)
        return {}
