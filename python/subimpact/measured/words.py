"""What is said of a measured force beside the computed one."""

from __future__ import annotations

import math
from typing import Any

_MOST_DECIMALS = 6
_NOT_KNOWN = "error of the computed one not known"


def rounded(value: float, error: float | None, unit: str) -> str:
    """With the digits that the error allows."""
    if not error or not math.isfinite(error):
        return f"{value:.6g} {unit}"
    decimals = min(max(1 - math.floor(math.log10(error)), 0), _MOST_DECIMALS)
    return f"{value:.{decimals}f} +- {max(error, 10.0**-decimals):.{decimals}f} {unit}"


def _difference(name: str, computed: float, measured: float, unit: str, note: str) -> dict[str, str]:
    percent = f": {100 * (computed - measured) / measured:+.2g} %" if measured else ""
    return {"name": name, "value": f"{computed:.4g} {unit} computed, {measured:.4g} measured{percent}", "note": note}


def answers_of(a: Any) -> list[dict[str, str]]:
    """Names, values and notes of an Alignment."""
    def known(error: float | None) -> str:
        return "as given" if error is None else "found"

    def times(factor: float, error: float | None) -> float | None:
        return None if error is None else factor * error

    answers = [{"name": "shift", "value": rounded(1e6 * a.shift, times(1e6, a.shift_error), "us"),
                "note": f"by which the measured time is later, {known(a.shift_error)}; correlation {a.correlation:.4f}, samples "
                        f"{1e6 * a.interval:.4g} us apart"}]
    if a.low_pass is not None:
        answers.append({"name": "low-pass", "value": rounded(1e-3 * a.low_pass, times(1e-3, a.low_pass_error), "kHz"),
                        "note": f"{known(a.low_pass_error)}; Butterworth, fourth order, on what is computed"})
    if a.gain != 1.0:
        answers.append({"name": "gain", "value": rounded(a.gain, a.gain_error, "").strip(),
                        "note": f"{known(a.gain_error)}; by which the measurement is divided"})
    c, m = a.computed, a.measured
    cover = f"from {1e6 * a.begin:.6g} to {1e6 * a.end:.6g} us of the run, which both cover"
    if a.quantity == "strain":
        return [*answers, _difference("largest strain", 1e6 * c.peak, 1e6 * m.peak, "um/m", f"{_NOT_KNOWN}; {cover}")]

    def side(difference: float, total: float | None, unit: str) -> str:
        if total is None:
            return _NOT_KNOWN
        return f"{'within' if abs(difference) <= total else 'outside'} the computed one's total error of {total:.2g} {unit}"

    return [*answers,
            _difference("largest force", c.peak, m.peak, "N", f"{side(c.peak - m.peak, a.total_error, 'N')}; at "
                        f"{1e6 * c.peak_time:.1f} and {1e6 * m.peak_time:.1f} us of the run"),
            _difference("impulse", c.impulse, m.impulse, "N s", f"{side(c.impulse - m.impulse, a.impulse_error, 'N s')}; {cover}"),
            _difference("time in contact", 1e6 * c.contact, 1e6 * m.contact, "us", f"{_NOT_KNOWN}; above 5 % of the largest force")]
