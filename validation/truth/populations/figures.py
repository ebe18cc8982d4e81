"""Figures of the map and of the ensemble, from the directory of their sweeps (the only argument)."""

import sys
import textwrap
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from scipy.special import ndtr

import subimpact as si

HERE = Path(__file__).parent
BEAM_MASS = 0.7112 * 0.0163 * 0.0075 * 2600.0
BEGIN_MARK = "<!-- results: written by scripts/study populations -->"
END_MARK = "<!-- end of results -->"
PUBLISHED = (15.9, 0.201 / BEAM_MASS)  # velocity, m/s, and ratio of masses

plt.rcParams.update({"font.size": 9, "hatch.linewidth": 0.5})


def save(figure, name):
    figure.savefig(HERE / name, bbox_inches="tight", dpi=130)
    plt.close(figure)


def edges(values):
    """Limits of the cells about values."""
    middles = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middles[0]], middles, [2 * values[-1] - middles[-1]]])


def draw_map(axes, runs, column, label, *, factor=1.0, doubtful=None, ticks=None, **colours):
    """Colours of a column over velocity and ratio of masses; cells that are doubtful are hatched, a
    ring is about the published strike."""

    def table(values):
        cells = runs.assign(shown=values).pivot(
            index="striker.mass", columns="striker.velocity", values="shown").astype(float)
        return cells.columns.to_numpy(), cells.index.to_numpy() / BEAM_MASS, cells.to_numpy()

    velocity, ratio, values = table(factor * runs[column])
    x, y = edges(velocity), np.exp(edges(np.log(ratio)))
    mesh = axes.pcolormesh(x, y, values, **colours)
    bar = axes.figure.colorbar(mesh, ax=axes, label=label, ticks=ticks)
    bar.ax.minorticks_off()
    if ticks is not None:
        bar.ax.set_yticklabels(ticks)
    if doubtful is not None:
        marked = table(doubtful)[2]
        axes.pcolor(x, y, np.ma.masked_where(marked != 1, marked), hatch="//////", alpha=0.0)
    axes.plot(*PUBLISHED, "o", color="white", markerfacecolor="none", markersize=7)
    axes.set(xlabel="velocity, m/s", yscale="log")
    axes.set_yticks([0.1, 0.2, 0.5, 1, 2, 4], ["0.1", "0.2", "0.5", "1", "2", "4"])
    axes.minorticks_off()


def draw_counts(runs):
    figure, (all_of_them, certain) = plt.subplots(1, 2, figsize=(10, 4.2), sharey=True)
    most = runs.n_sub_impacts.max()
    ticks = [n for n in (5, 10, 20, 30, 50, 70, 100) if n <= most]
    draw_map(all_of_them, runs, "n_sub_impacts", "sub-impacts within 8 ms", ticks=ticks,
             norm=matplotlib.colors.LogNorm(runs.n_sub_impacts.min(), most), doubtful=runs.all_certain != 1)
    draw_map(certain, runs, "n_certain", "sub-impacts that are certain in count and order", vmin=0,
             ticks=list(range(0, int(runs.n_certain.max()) + 1, 5)))
    all_of_them.set(ylabel="mass of the striker over that of the beam",
                    title="sub-impacts of the run; hatched: not certain")
    certain.set(title="leading sub-impacts that are certain")
    save(figure, "counts.png")


def draw_first_separation(runs):
    figure, axes = plt.subplots(figsize=(6.5, 4.4))
    draw_map(axes, runs, "first_separation_s", "us", factor=1e6, cmap="magma",
             doubtful=runs.n_certain == 0)
    axes.set(ylabel="mass of the striker over that of the beam",
             title="end of the first contact; hatched: not certain")
    save(figure, "first_separation.png")


def share_in_contact(sub_impacts, n_runs, times, end):
    """The share of runs that are in contact at each time."""
    starts = np.sort(sub_impacts["start_s"].to_numpy())
    ends = np.sort(sub_impacts["end_s"].fillna(end + 1.0).to_numpy())
    return (np.searchsorted(starts, times, "right") - np.searchsorted(ends, times, "right")) / n_runs


def linear_prediction(plan, times):
    """Probability of contact if every event time were normal, with the standard deviation that its
    derivatives give; up to the first sub-impact that scatters by more than its duration, or by an
    unknown amount. And the run with these deviations."""
    scatter = {f"scatter.{key}": deviation for key, deviation in plan.scatter.items()}
    run = si.sensitivity(plan.case.changed(scatter), list(plan.scatter), jobs=2).base
    probability = np.zeros_like(times)
    last = times[-1]
    for row in run.sub_impacts:
        largest = max(row["start_scatter_s"], row["end_scatter_s"])
        if not largest <= row["duration_s"]:
            last = row["start_s"]
            break
        for name, sign in (("start", 1), ("end", -1)):
            deviation = max(row[f"{name}_scatter_s"], 1e-12)
            probability += sign * ndtr((times - row[f"{name}_s"]) / deviation)
    return np.where(times <= last, np.clip(probability, 0.0, 1.0), np.nan), run


def zone_limits(run):
    """Starts and ends of zones with their standard deviations, s."""
    limits = []
    for zone, scatter in zip(run.summary["zones"], run.summary["predictability"]["zones"]):
        for name in ("start", "end"):
            if zone[f"{name}_s"] and scatter[f"{name}_scatter_s"]:
                limits.append((zone[f"{name}_s"], scatter[f"{name}_scatter_s"]))
    return limits


def draw_ensemble(directory):
    plan = si.Plan.from_file(HERE / "ensemble.toml")
    runs = pd.read_csv(directory / "runs.csv")
    sub_impacts = pd.read_csv(directory / "sub_impacts.csv")
    end = plan.case["time.end"]
    times = np.linspace(0.0, end, 8001)
    share = share_in_contact(sub_impacts, len(runs), times, end)
    linear, run = linear_prediction(plan, times)
    figure, (whole, zone) = plt.subplots(2, 1, figsize=(6.5, 5.5))
    for axes, last in ((whole, end), (zone, 2e-3)):
        axes.fill_between(1e3 * times, share, color="tab:blue", alpha=0.35, linewidth=0,
                          label=f"{len(runs)} runs")
        axes.plot(1e3 * times, linear, color="tab:red", linewidth=0.8, label="linear prediction")
        for time, deviation in zone_limits(run):
            axes.axvspan(1e3 * (time - 2 * deviation), 1e3 * (time + 2 * deviation), color="tab:red",
                         alpha=0.12, linewidth=0)
        axes.set(xlim=(0, 1e3 * last), ylim=(0, 1.05), ylabel="probability of contact")
    zone.set_xlabel("time, ms")
    whole.legend(loc="upper center")
    save(figure, "contact_probability.png")
    counts = runs.n_sub_impacts.value_counts()
    return (f"The ensemble: {len(runs)} of {len(plan)} runs, {(runs.outcome == 'completed').sum()} completed, with "
            f"{runs.n_sub_impacts.min()} to {runs.n_sub_impacts.max()} sub-impacts, most often {counts.idxmax()} "
            f"({counts.max()} runs). By first derivatives {run.n_predictable} leading sub-impacts can be predicted: "
            f"{run.summary['predictability']['reason']}.")


def words_on_map(runs):
    plan = si.Plan.from_file(HERE / "map.toml")
    done = runs[runs.outcome == "completed"]
    return (f"The map: {len(runs)} of {len(plan)} cases, {len(done)} completed, with {done.n_sub_impacts.min()} to "
            f"{done.n_sub_impacts.max()} sub-impacts. In {(done.all_certain == 1).sum()} cases all of them are certain, in "
            f"{(done.wish_met == 1).sum()} every event is within the tolerance, in {(done.n_certain > 0).sum()} the first "
            f"separation is certain, with an error of {1e6 * done.first_separation_error_s.median():.2g} us in the median.")


def renew_results(text):
    """Writes a text between the marks of the page."""
    page = HERE / "README.md"
    text = "\n\n".join(textwrap.fill(paragraph, 120) for paragraph in text.split("\n\n"))
    before, rest = page.read_text(encoding="utf-8").split(BEGIN_MARK)
    after = rest.split(END_MARK)[1]
    page.write_text(f"{before}{BEGIN_MARK}\n{text}\n{END_MARK}{after}", encoding="utf-8")


def main():
    directory = Path(sys.argv[1])
    runs = pd.read_csv(directory / "map" / "runs.csv")
    draw_counts(runs)
    draw_first_separation(runs)
    text = f"{words_on_map(runs)}\n\n{draw_ensemble(directory / 'ensemble')}"
    renew_results(text)
    print(text)


if __name__ == "__main__":
    main()
