"""Populations of strikes: a plan that expands to cases, engines that run them, a store of results."""

from .plan import Plan
from .running import Sweep, sweep

__all__ = ["Plan", "Sweep", "sweep"]
