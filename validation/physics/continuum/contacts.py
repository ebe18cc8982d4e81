"""Contacts of one body beside those of others: joining by opening, tables in Markdown."""

import pandas as pd

LIMITS = (0, 0.1, 0.3, 1, 2, 3, 5, 10, 30)


def joined(contacts, opening):
    """Contacts parted by no more than `opening` um count as one. The last one keeps its opening, whatever it is."""
    rows = []
    for contact in contacts.to_dict("records"):
        if rows and rows[-1]["opening_um"] <= opening:
            last = rows[-1]
            last |= {"end_us": contact["end_us"], "opening_um": contact["opening_um"],
                     "striker_m_s": contact["striker_m_s"], "impulse_Ns": last["impulse_Ns"] + contact["impulse_Ns"],
                     "largest_force_N": max(last["largest_force_N"], contact["largest_force_N"])}
        else:
            rows.append(dict(contact))
    return pd.DataFrame(rows)


def markdown(header, rows):
    lines = ["| " + " | ".join(map(str, header)) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def written(contact):
    opening = contact.opening_um
    if contact.end_us != contact.end_us:
        return f"from {contact.start_us:.1f} on"
    return f"{contact.start_us:.1f} to {contact.end_us:.1f}" + (f" ({opening:.3g})" if opening == opening else "")


def middle(contact):
    return contact.start_us if contact.end_us != contact.end_us else 0.5 * (contact.start_us + contact.end_us)


def alongside(found, until, opening):
    """Contacts that start before `until`, each beside the one of the first body to whose middle its own is nearest."""
    of_body = {name: [c for c in joined(run["contacts"], opening).itertuples() if c.start_us < until]
               for name, run in found.items()}
    first = next(iter(of_body.values()))
    rows = [[""] * len(of_body) for _ in first]
    for column, contacts in enumerate(of_body.values()):
        for contact in contacts:
            nearest = min(range(len(first)), key=lambda n: abs(middle(first[n]) - middle(contact)))
            rows[nearest][column] += ("<br>" if rows[nearest][column] else "") + written(contact)
    return (f"Contacts in us, with the opening after each in um; those parted by less than {opening:g} um are joined.\n\n"
            + markdown(["", *of_body], [[n + 1, *row] for n, row in enumerate(rows)]))


def apart(one, other, since, until, opening):
    """Distances in us of each start and end of either from the nearest start, or end, of the other."""
    found = []
    for kind in ("start_us", "end_us"):
        times = [joined(run["contacts"], opening)[kind].dropna() for run in (one, other)]
        for some, others in (times, times[::-1]):
            found += [(others - t).abs().min() for t in some if since <= t <= until]
    return pd.Series(found, dtype=float)


def distance(one, other, since, until, opening):
    if other is one:
        return ""
    found = apart(one, other, since, until, opening)
    return f"{found.max():.1f}, {found.median():.1f}" if len(found) else ""


def totals(found, since, until, opening):
    runs = [*found.values()]
    times = f"times from {since:g} to {until:g} us apart from those of the first by, us: largest, median"
    rows = [(times, *(distance(runs[0], run, since, until, opening) for run in runs)),
            ("largest force, kN", *(f"{1e-3 * run['contacts'].largest_force_N.max():.2f}" for run in runs)),
            ("striker at the end, m/s", *(f"{run['striker_m_s']:.3f}" for run in runs)),
            ("impulse, N s", *(f"{run['contacts'].impulse_Ns.sum():.4f}" for run in runs)),
            ("permanent set, mm", *(f"{run['set_mm']:.2f}" if run["set_mm"] == run["set_mm"] else "" for run in runs)),
            ("energy error", *(f"{run['energy_error']:.1e}" for run in runs))]
    return markdown(["", *found], rows)


def counted(found):
    rows = [(name, *(len(joined(run["contacts"], limit)) for limit in LIMITS)) for name, run in found.items()]
    return "Contacts that remain when those parted by less than so many um are joined:\n\n" + markdown(["", *LIMITS], rows)
