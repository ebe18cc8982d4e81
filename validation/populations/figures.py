"""Figures of the map and of the ensemble, from the directory of their sweeps (the only argument)."""

import sys
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

plt.rcParams.update({"svg.hashsalt": "subimpact", "font.size": 9, "figure.figsize": (6.5, 4.4)})


def save(figure, name):
    metadata = {"Date": None} if name.endswith(".svg") else {}
    figure.savefig(HERE / name, metadata=metadata, bbox_inches="tight", dpi=130)
    plt.close(figure)


def grid(runs, column):
    table = runs.pivot(index="striker.mass", columns="striker.velocity", values=column)
    return table.columns.to_numpy(), table.index.to_numpy() / BEAM_MASS, table.to_numpy(dtype=float)


def map_axes(title):
    figure, axes = plt.subplots()
    axes.set(xlabel="velocity, m/s", ylabel="mass of the striker over that of the beam", yscale="log",
             title=title)
    return figure, axes


def draw_counts(runs):
    figure, axes = map_axes("sub-impacts within 8 ms; crosses: the count is not decided")
    velocity, ratio, counts = grid(runs, "n_sub_impacts")
    mesh = axes.pcolormesh(velocity, ratio, counts, shading="nearest", cmap="viridis", rasterized=True)
    figure.colorbar(mesh, label="sub-impacts")
    unsure = runs[runs.all_decided != 1]
    axes.plot(unsure["striker.velocity"], unsure["striker.mass"] / BEAM_MASS, "x", color="white",
              markersize=2, markeredgewidth=0.4)
    save(figure, "counts.svg")
    figure, axes = map_axes("leading sub-impacts that are decided")
    velocity, ratio, counts = grid(runs, "n_decided")
    mesh = axes.pcolormesh(velocity, ratio, counts, shading="nearest", cmap="viridis", rasterized=True)
    figure.colorbar(mesh, label="decided sub-impacts")
    save(figure, "decided.svg")


def draw_first_separation(runs):
    figure, axes = map_axes("end of the first contact, us; crosses: its existence is not decided")
    velocity, ratio, times = grid(runs, "first_separation_s")
    mesh = axes.pcolormesh(velocity, ratio, 1e6 * times, shading="nearest", cmap="magma",
                           norm=matplotlib.colors.LogNorm(), rasterized=True)
    figure.colorbar(mesh, label="us")
    unsure = runs[runs.n_decided == 0]
    axes.plot(unsure["striker.velocity"], unsure["striker.mass"] / BEAM_MASS, "x", color="white",
              markersize=2, markeredgewidth=0.4)
    save(figure, "first_separation.svg")


def share_in_contact(sub_impacts, n_runs, times, end):
    """The share of runs that are in contact at each time."""
    starts = np.sort(sub_impacts["start_s"].to_numpy())
    ends = np.sort(sub_impacts["end_s"].fillna(end + 1.0).to_numpy())
    return (np.searchsorted(starts, times, "right") - np.searchsorted(ends, times, "right")) / n_runs


def linear_prediction(plan, times):
    """Probability of contact if every event time were normal, with the standard deviation that its
    derivatives give; up to the first sub-impact without. And the run with these deviations."""
    scatter = {f"scatter.{key}": deviation for key, deviation in plan.scatter.items()}
    run = si.sensitivity(plan.case.changed(scatter), list(plan.scatter), jobs=2).base
    probability = np.zeros_like(times)
    last = times[-1]
    for row in run.sub_impacts:
        if not np.isfinite([row["start_scatter_s"], row["end_scatter_s"]]).all():
            last = row["start_s"]
            break
        for name, sign in (("start", 1), ("end", -1)):
            deviation = max(row[f"{name}_scatter_s"], 1e-12)
            probability += sign * ndtr((times - row[f"{name}_s"]) / deviation)
    return np.where(times <= last, probability, np.nan), run


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
        axes.set(xlim=(0, 1e3 * last), ylim=(0, 1.05), ylabel="probability of contact")
    zone.set_xlabel("time, ms")
    whole.legend(loc="upper center")
    save(figure, "contact_probability.png")
    counts = runs.n_sub_impacts.value_counts().sort_index()
    print(f"ensemble: {len(runs)} runs, {runs.n_sub_impacts.min()} to {runs.n_sub_impacts.max()} sub-impacts, "
          f"most often {counts.idxmax()} ({counts.max()} runs); {run.n_predictable} sub-impacts can be predicted: "
          f"{run.summary['predictability']['reason']}")


def main():
    directory = Path(sys.argv[1])
    runs = pd.read_csv(directory / "map" / "runs.csv")
    draw_counts(runs)
    draw_first_separation(runs)
    print(f"map: {len(runs)} cases, {(runs.outcome == 'completed').sum()} completed, "
          f"{(runs.all_decided == 1).sum()} with all sub-impacts decided, {(runs.wish_met == 1).sum()} within the wish, "
          f"{(runs.n_decided > 0).sum()} with the first separation decided")
    draw_ensemble(directory / "ensemble")


if __name__ == "__main__":
    main()
