#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Plots a report of `boxwood study influence`: what rays cost in the trees of each builder, relative to SAH+LSPH.

    scripts/plot_influence.py study.json -o influence.png

Left: over all boxes that the rays meet; hollow marks are the published ratios. Right: in search of the closest hit.
One row of marks for each kind of area and orientation: geometric means. Needs matplotlib (Debian: python3-matplotlib;
scripts/setup.sh --checks installs it).
"""
import argparse
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

# Colours that differ for colour-blind readers too (Okabe and Ito 2008), and a marker each.
STYLES = [("#000000", "s"), ("#0072B2", "o"), ("#D55E00", "v"), ("#CC79A7", "^"), ("#E69F00", "D"), ("#56B4E9", "P"),
          ("#009E73", "X")]


def read_groups(file):
    """The groups and the builders. Ends the program where the file is no report of the study."""
    try:
        groups = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))["groups"]
        for group in groups.values():
            for key in ("geomean", "geomean_to_hit", "published_geomean"):
                for ratio in group[key].values():
                    math.log(ratio)
        builders = list(groups["all"]["geomean"])
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        sys.exit(f"plot_influence: {file}: not a report of boxwood study influence ({error!r})")
    if not builders:
        sys.exit(f"plot_influence: {file}: has no ratios to plot")
    return groups, builders


def plot(axes, groups, builders, key, title):
    for row, group in enumerate(groups.values()):
        for builder, (colour, marker) in zip(builders, STYLES):
            if builder in group[key]:
                axes.scatter(group[key][builder], row, color=colour, marker=marker, s=56, zorder=3, edgecolors="white",
                             linewidths=0.8, label=builder)
            if key == "geomean" and builder in group["published_geomean"]:
                axes.scatter(group["published_geomean"][builder], row, facecolors="none", edgecolors=colour,
                             marker=marker, s=56, zorder=2)
    axes.axvline(1.0, color="#bbbbbb", linewidth=1.5, zorder=1)
    axes.set_yticks(range(len(groups)), groups.keys())
    axes.set_xscale("log")
    axes.xaxis.set_minor_locator(matplotlib.ticker.LogLocator(subs=(1.2, 1.5, 2, 3, 4, 5, 6, 7, 8, 9)))
    axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
    axes.xaxis.set_minor_formatter(lambda x, _: f"{x:g}")
    axes.set_xlabel("cost relative to SAH+LSPH")
    axes.set_title(title, loc="left", fontsize=11, fontweight="bold")
    axes.grid(color="#eeeeee", zorder=0)
    axes.spines[["top", "right"]].set_visible(False)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", help="report of boxwood study influence (JSON)")
    parser.add_argument("-o", "--output", required=True,
                        help="picture to write; its ending says the kind (.png, .svg, .pdf)")
    arguments = parser.parse_args()
    groups, builders = read_groups(arguments.report)

    height = 1.8 + 0.36 * len(groups)
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, height), sharey=True, layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - 0.4 / height)) # the legend lies above
    plot(left, groups, builders, "geomean", "all boxes on the ray")
    plot(right, groups, builders, "geomean_to_hit", "search for the closest hit")
    left.invert_yaxis() # of both
    handles = dict(zip(*reversed(left.get_legend_handles_labels())))
    figure.legend(handles.values(), handles.keys(), loc="upper center", ncol=len(builders), frameon=False)
    try:
        figure.savefig(arguments.output, dpi=150)
    except (OSError, ValueError) as error:
        sys.exit(f"plot_influence: {arguments.output}: {error}")


if __name__ == "__main__":
    main()
