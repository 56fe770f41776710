#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Plots reports of `boxwood quality`: what the time of the volume passes buys, one row of plots for each scene.

    scripts/plot_quality.py bunny.json dragon.json -o quality.png

Left: the sum of the volumes of all nodes, relative to AABBs. Right: volumes that a bounce ray tests. Both against the
device time of the volume passes (AABBs, and the fit of oriented boxes after them). A line joins the kinds that no other
kind beats in both time and worth. Needs matplotlib (Debian: python3-matplotlib; scripts/setup.sh --checks installs it).
"""
import argparse
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator  # noqa: E402

# Colours that differ for colour-blind readers too (Okabe and Ito 2008), and a marker each.
STYLES = {
    "aabb": ("#000000", "s"),
    "obb-points": ("#0072B2", "o"),
    "obb-boxes": ("#D55E00", "v"),
    "obb-quaternion": ("#CC79A7", "^"),
    "obb-cascade": ("#E69F00", "D"),
    "obb-moments": ("#009E73", "P"),
    "obb-moments-corners": ("#56B4E9", "X"),
    "obb-refined": ("#882255", "*"),
}
OTHER = ("#777777", "o")


def read_report(file):
    """The report and a name for its scene. Ends the program where the file is none of `boxwood quality`."""
    try:
        report = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))
        for kind in report["kinds"].values():
            kind["passes_ms"]["volumes"], kind["volume_ratio"], kind["bounce"]["volumes_per_ray"]
        triangles = report["scene"]["triangles"]
        return pathlib.Path(report["scene"]["file"]).stem + f", {triangles:,} triangles", report["kinds"]
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        sys.exit(f"plot_quality: {file}: not a report of boxwood quality ({error!r})")


def volume_time(kind):
    return kind["passes_ms"]["aabb_volumes"] + kind["passes_ms"]["volumes"]


def front(points):
    """Those (time, worth) that no other has less time than, and as little or less of the rest; by time."""
    kept = []
    for time, value in sorted(points):
        if not kept or value < kept[-1][1]:
            kept.append((time, value))
    return kept


def plot(axes, kinds, value, label):
    points = [(volume_time(kind), value(kind)) for kind in kinds.values()]
    best = front(points)
    axes.step(*zip(*best), where="post", color="#bbbbbb", linewidth=1.5, zorder=1)
    for key, kind in kinds.items():
        colour, marker = STYLES.get(key, OTHER)
        axes.scatter(volume_time(kind), value(kind), color=colour, marker=marker, s=130 if marker == "*" else 64,
                     label=key, zorder=2, edgecolors="white", linewidths=0.8)
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(base=10, subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axes.xaxis.set_minor_formatter(FuncFormatter(lambda *_: ""))
    axes.set_ylabel(label)
    axes.set_xlabel("volume passes, ms")
    axes.grid(color="#eeeeee", zorder=0)
    axes.spines[["top", "right"]].set_visible(False)
    axes.margins(0.08, 0.12)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reports", nargs="+", help="reports of boxwood quality (JSON)")
    parser.add_argument("-o", "--output", required=True,
                        help="picture to write; its ending says the kind (.png, .svg, .pdf)")
    arguments = parser.parse_args()
    scenes = [read_report(file) for file in arguments.reports]

    height = 0.8 + 3.4 * len(scenes)
    figure, rows = plt.subplots(len(scenes), 2, figsize=(11, height), squeeze=False, layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - 0.7 / height)) # the legend lies above
    for (name, kinds), (left, right) in zip(scenes, rows):
        left.set_title(name, loc="left", fontsize=11, fontweight="bold")
        plot(left, kinds, lambda kind: kind["volume_ratio"], "sum of volumes, relative to AABBs")
        plot(right, kinds, lambda kind: kind["bounce"]["volumes_per_ray"], "volumes tested per bounce ray")
    handles = {}
    for row in rows:
        for handle, key in zip(*row[0].get_legend_handles_labels()):
            handles.setdefault(key, handle)
    figure.legend(handles.values(), handles.keys(), loc="upper center", ncol=4, frameon=False)
    try:
        figure.savefig(arguments.output, dpi=150)
    except (OSError, ValueError) as error:
        sys.exit(f"plot_quality: {arguments.output}: {error}")


if __name__ == "__main__":
    main()
