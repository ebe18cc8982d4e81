"""Units of time, force, strain, voltage, charge and acceleration, as instruments and spreadsheets write them."""

from __future__ import annotations

import re
from typing import NamedTuple

_PREFIXES = {"": 1.0, "G": 1e9, "M": 1e6, "k": 1e3, "m": 1e-3, "u": 1e-6, "n": 1e-9, "p": 1e-12}
_WORDS = {"": "", "G": "giga", "M": "mega", "k": "kilo", "m": "milli", "u": "micro", "n": "nano", "p": "pico"}
#: What a second, newton, volt and hertz are called beside their symbols.
_NAMES = {
    "s": ("sec", "secs", "second", "seconds", "sekunde", "sekunden"),
    "N": ("newton", "newtons"),
    "V": ("volt", "volts"),
    "Hz": ("hertz",),
}
#: Kinds by symbol, and their prefixes: nobody writes "MV" or "ks" who does not mean mV or something else.
_KINDS = {"s": ("time", "munp"), "N": ("force", "GMkmun"), "V": ("voltage", "kmun"), "C": ("charge", "munp"),
          "Hz": ("frequency", "GMk"), "S/s": ("frequency", "GMk")}
#: Of columns that are neither time nor force.
_OTHERS = ("m mm um cm in ft m/s mm/s cm/s in/s ft/s km/h mph Pa kPa MPa GPa hPa bar mbar psi ksi psf N/mm2 kN/m2 Nm °C C °F K % rpm 1/min "
           "A mA ° deg rad dB")
_STANDARD_GRAVITY = 9.80665  # m/s^2


class Unit(NamedTuple):
    """Values times `factor` are in SI."""

    kind: str  #: "time", "force", "strain", "voltage", "charge", "acceleration", "frequency" or "other"
    factor: float
    symbol: str


def _table() -> dict[str, Unit]:
    table = {}
    for base, (kind, prefixes) in _KINDS.items():
        for prefix in ["", *prefixes]:
            unit = Unit(kind, _PREFIXES[prefix], prefix + base)
            table[prefix + base] = unit
            for name in _NAMES.get(base, ()):
                table[_WORDS[prefix] + name] = table[prefix + name] = unit
    del table["C"]  # Celsius, mostly
    # "S", "uS" and "KN" are careless, but of a signal nothing else; "MS", "MV" and "kg" may be anything.
    for careless, symbol in {"S": "s", "mS": "ms", "uS": "us", "US": "us", "nS": "ns", "NS": "ns", "KN": "kN",
                             "Sa/s": "S/s", "kSa/s": "kS/s", "MSa/s": "MS/s", "1/s": "Hz"}.items():
        table[careless] = table[symbol]
    for symbol, factor in {"lbf": 4.4482216152605, "lbs": 4.4482216152605, "kip": 4448.2216152605, "kips": 4448.2216152605,
                           "klbf": 4448.2216152605, "ozf": 0.27801385095378, "kgf": _STANDARD_GRAVITY,
                           "kp": _STANDARD_GRAVITY, "cN": 0.01, "daN": 10.0}.items():
        table[symbol] = Unit("force", factor, symbol)
    for symbols, unit in {"min": Unit("time", 60.0, "min"), "g G gn": Unit("acceleration", _STANDARD_GRAVITY, "g"),
                          "m/s2 m/s/s ms-2 m/sec2": Unit("acceleration", 1.0, "m/s^2"), "strain m/m ε": Unit("strain", 1.0, "m/m"),
                          "um/m microstrain ustrain uε": Unit("strain", 1e-6, "um/m"), "mm/m": Unit("strain", 1e-3, "mm/m")}.items():
        table.update(dict.fromkeys(symbols.split(), unit))
    for length, metres in {"mm": 1e-3, "cm": 1e-2, "in": 0.0254, "ft": 0.3048}.items():
        table[f"{length}/s2"] = table[f"{length}/s/s"] = Unit("acceleration", metres, f"{length}/s^2")
    return {**table, **{symbol: Unit("other", 1.0, symbol) for symbol in _OTHERS.split()}}


_UNITS = _table()
BRACKETS = re.compile(r"[\[({<]\s*([^\[\](){}<>]+?)\s*[\])}>]")
_QUANTITIES = r"t|time|zeit|f|force|kraft|load|u|voltage|spannung|a|acceleration|beschleunigung"
_GROUPS = re.compile(r"\s*[-+]?[1-9]\d{0,2}(?:(?P<mark>[ .,])\d{3})(?:(?P=mark)\d{3})*(?![\d.,])")
#: What tells that numbers are not those of the unit that follows or stands before: "Force [N] x 1000", "F/1000 (N)", "-F (N)",
#: "log F (N)"; not "Max 50 (N)", "Force/1 - Untitled (N)" or a date.
_SCALED = re.compile(rf"(?:\b(?:{_QUANTITIES}|strain|dehnung)|[])}}>])\s*\(?\s*(?:[x*×·]\s*[-+]?\d|/\s*(?:\d{{2}}|\d[\d.]*e))"
                     rf"|10\s*\^|^\s*-|^\s*(?:log|lg|ln)\w*\W*(?:f|force|kraft|load|strain)\b|[])}}>]\s*\d[\d.]*(?:e[-+]?\d+)?\s*$",
                     re.IGNORECASE)
_FRACTION = re.compile(rf"\s*(?:{_QUANTITIES})\s*/\s*(.+)", re.IGNORECASE)  # "F/N"


def unit_of(text: str) -> Unit | None:
    """The unit that this is, such as "us" or "(kN)"."""
    text = text.strip().strip("[](){}<>\"'").strip().replace("µ", "u").replace("μ", "u").replace("²", "2")
    text = text.removesuffix(".")  # "Sec."
    text = re.sub(r"(?<=[a-z0-9/])[\s^*·.]+(?=[-a-z0-9(])", "", text) if re.match(r"m|(?:cm|in|ft)\b", text) else text
    return _UNITS.get(text) or (_UNITS.get(text.lower()) if len(text) > 2 and text.isalpha() else None)


def unit_in(name: str) -> Unit | None:
    """The unit that a heading ends in: "Time (us)", "time_us", "F/N", "Kraft in kN"; not "v_m_per_s"."""
    if _SCALED.search(name):
        return None
    if brackets := BRACKETS.findall(name):
        units = [unit for text in brackets if (unit := unit_of(text))]
        units = [unit for unit in units if unit.kind != "other"] or units
        return units[-1] if units and (len(units) == 1 or units[-2].kind != units[-1].kind) else None
    return _unit_without_brackets(name)


def _unit_without_brackets(name: str) -> Unit | None:
    """Where the names of many units are mere words: "in", "bar", "A"."""
    if fraction := _FRACTION.fullmatch(name):
        return unit_of(fraction[1])
    if (whole := unit_of(name)) and whole.kind != "other":
        return whole
    if channel := re.fullmatch(r"CH\d(m?V)", name.strip()):
        return unit_of(channel[1])
    words = re.split(r"[\s_,:;-]+", name.strip())
    if len(words) < 2 or "per" in words or re.fullmatch(r"[x*]?\d[\d.^eE+]*", words[-2]):  # "v_m_per_s", "10^-6 s"
        return None
    last = unit_of(words[-1])
    return last if last and last.kind != "other" else None


def quantity(text: str, decimal: str = ".") -> tuple[float, str] | None:
    """A number and what follows it: "2.27 mV/N"; a decimal comma counts as a point. None also for "1,000", which may be a
    thousand, where decimals begin with the other mark; "1,000,000" and "1 000" are no decimals anyway."""
    if groups := _GROUPS.match(text):
        number, mark = groups[0], groups["mark"]
        if number.count(mark) == 1 and mark not in (" ", decimal):
            return None
        if number.count(mark) > 1 or mark == " ":
            text = number.replace(mark, "") + text[groups.end():]
    match = re.fullmatch(r"\s*([-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][-+]?\d+)?)\s*(\D.*)?", text.strip())
    return (float(match[1].replace(",", ".")), (match[2] or "").strip()) if match else None


def value_in(kind: str, text: str) -> float | None:
    """A number with a unit of this kind, such as "-12.5us", in SI; None for anything else."""
    parts = quantity(text)
    unit = unit_of(parts[1]) if parts else None
    return parts[0] * unit.factor if parts and unit and unit.kind == kind else None


class Sensitivity(NamedTuple):
    """What a transducer gives: electrical values divided by `per` are newtons or m/s^2."""

    electrical: str  #: "voltage" or "charge"
    per: float
    mechanical: str  #: "force" or "acceleration"


def sensitivity_of(text: str) -> Sensitivity | None:
    """That of "2.27 mV/N", "10 mV/g", "3.9 pC per N" or "440 N/V"."""
    parts = quantity(text.replace(" per ", "/"))
    if not parts or parts[0] == 0.0:
        return None
    upper, _, lower = parts[1].partition("/")
    if upper.strip() == "m" and lower.count("/") > 0:  # m/s^2/V
        upper, _, lower = parts[1].rpartition("/")
    above, below = unit_of(upper), unit_of(lower)
    if above is None or below is None:
        return None
    per = parts[0] * above.factor / below.factor
    if above.kind in ("voltage", "charge") and below.kind in ("force", "acceleration"):
        return Sensitivity(above.kind, per, below.kind)
    if below.kind in ("voltage", "charge") and above.kind in ("force", "acceleration"):
        return Sensitivity(below.kind, 1.0 / per, above.kind)
    return None
