"""Populations of strikes: a plan that expands to cases, engines that run them, a store of results.

The engines are those of others: the pool of processes of Python's library, Dask, MPI through
mpi4py, or any other object with the interface of `concurrent.futures.Executor`.
"""

from .plan import Plan
from .running import Sweep, sweep

__all__ = ["Plan", "Sweep", "sweep"]
