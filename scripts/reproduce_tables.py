#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables 4 and 5 of the dissertation again: runs `boxwood quality` on the scenes of a folder and prints what it finds
beside the published figures (Sabino 2020, tables 4 and 5).

    scripts/reproduce_tables.py ../scenes --reports output

Scenes that the tool refuses are named and left out. Reports stay in the folder of --reports (for
scripts/plot_quality.py); with --reuse those already there are read and not made again.
"""
import argparse
import json
import pathlib
import subprocess
import sys

# The dissertation's kinds, in its order.
PUBLISHED_KINDS = ["obb-points", "obb-boxes", "obb-quaternion"]

# Table 4, single level and two levels: sum of volumes relative to AABBs, and the share of nodes whose OBB is smaller,
# in %. By the start of a file's name. Two levels give no share for all nodes (and none at all for the top of
# obb-points).
TABLE_4 = {
    ("bunny", "one"): {"obb-points": (0.91081, 97.2), "obb-boxes": (0.99065, 76.1), "obb-quaternion": (0.99389, 71.7)},
    ("sponza", "one"): {"obb-points": (0.98022, 78.0), "obb-boxes": (0.98655, 54.1), "obb-quaternion": (0.99614, 52.9)},
    ("sponza", "two"): {"obb-points": (0.80325, None), "obb-boxes": (0.95556, None), "obb-quaternion": (0.96017, None)},
}
TABLE_4_TWO_TO_ONE = {"sponza": 2.50726 / 5.33077}

# Table 5, ms: codes, sort, nodes, then volumes by kind; processor (CPU) and graphics processor (GPU). None: over a
# minute, or not given.
TABLE_5 = {
    "dragon": {"CPU": (14.40, 100.80, 28.42, 626.26, 316.26, 520.10), "GPU": (13.14, None, 2.08, None, 50.90, 50.04)},
    "sponza": {"CPU": (4.27, 23.62, 8.52, 723.99, 756.01, 490.58), "GPU": (3.81, None, 0.64, None, 14.14, 13.40)},
    "bunny": {"CPU": (2.37, 12.51, 4.36, 90.27, 51.90, 84.76), "GPU": (1.90, None, 0.36, None, 7.67, 7.23)},
    "sibenik": {"CPU": (1.26, 6.44, 2.50, 60.60, 42.96, 53.53), "GPU": (0.85, None, 0.21, None, 5.04, 4.70)},
}
TABLE_5_LEAST = 10_000  # triangles


def print_table(title, rows):
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    print("\n" + title)
    for row in rows:
        cells = [cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(row, widths))]
        print("  ".join(cells).rstrip())


def number(value, digits):
    return "-" if value is None else f"{value:.{digits}f}"


def by_name(table, scene):
    """The entry of `table` whose key the scene's name starts with."""
    return next((entry for start, entry in table.items() if scene.startswith(start)), None)


def make_report(arguments, scene):
    """The report on one scene, or None when the tool refuses it."""
    file = arguments.reports / (scene.stem + ".json")
    if not (arguments.reuse and file.exists()):
        print(f"measuring {scene.name}", file=sys.stderr)
        command = [arguments.tool, "quality", scene, "--quiet", "--resolution", "512x512", "--bounds", arguments.bounds,
                   "--report", file]
        run = subprocess.run([str(word) for word in command], stderr=subprocess.PIPE, text=True, check=False)
        if run.returncode != 0:
            print(f"left out: {scene.name}: {run.stderr.strip()}")
            return None
    try:
        report = json.loads(file.read_text(encoding="utf-8"))
        report["requirements"]
        for kind in report["kinds"].values():
            kind["sum_volume"], kind["fit_ratio"], kind["passes_ms"]
        return report
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        sys.exit(f"reproduce_tables: {file}: not a report of boxwood quality ({error!r})")


def levels_of(report):
    """{"one": {kind: sums}, "two": ...}, whichever the report has."""
    if "levels" in report:
        return {level: {key: kind["all"] for key, kind in kinds.items()} for level, kinds in report["levels"].items()}
    level = "two" if "two-levels" in report["requirements"] else "one"
    return {level: report["kinds"]}


def table_4(reports):
    rows = [["scene, levels, kind", "volume / aabb", "published", "OBB smaller, %", "published"]]
    for scene, report in reports.items():
        for level, kinds in levels_of(report).items():
            known = next((known for (start, at), known in TABLE_4.items()
                          if scene.startswith(start) and at == level), {})
            for key, sums in kinds.items():
                if key == "aabb":
                    continue
                published = known.get(key, (None, None))
                ratio = sums["sum_volume"] / kinds["aabb"]["sum_volume"] if kinds["aabb"]["sum_volume"] else 1.0
                rows.append([f"{scene}, {level}, {key}", number(ratio, 5), number(published[0], 5),
                             number(100 * sums["obb_smaller_fraction"], 1), number(published[1], 1)])
    print_table("Table 4: sum of the volumes of all nodes", rows)

    rows = [["scene, kind", "one level", "two levels", "two / one", "published (aabb)"]]
    for scene, report in reports.items():
        levels = levels_of(report)
        for key in levels["one"] if len(levels) == 2 else []:
            one, two = levels["one"][key]["sum_volume"], levels["two"][key]["sum_volume"]
            published = by_name(TABLE_4_TWO_TO_ONE, scene) if key == "aabb" else None
            rows.append([f"{scene}, {key}", f"{one:.6g}", f"{two:.6g}", number(two / one if one else 1.0, 4),
                         number(published, 4)])
    if len(rows) > 1:
        print_table("Table 4: one level against two", rows)


def table_5(reports):
    kinds = list(dict.fromkeys(kind for report in reports.values() for kind in report["kinds"] if kind != "aabb"))
    order = PUBLISHED_KINDS + [kind for kind in kinds if kind not in PUBLISHED_KINDS]
    rows = [["scene", "codes", "sort", "nodes", "AABBs"] + order]
    for scene, report in reports.items():
        if report["scene"]["triangles"] < TABLE_5_LEAST:
            continue
        passes = {key: kind["passes_ms"] for key, kind in report["kinds"].items()}
        steps = ("morton", "sort", "hierarchy", "aabb_volumes")
        rows.append([scene] + [number(passes["aabb"][step], 2) for step in steps] +
                    [number(passes[kind]["volumes"], 2) if kind in passes else "-" for kind in order])
        rows.append(["  times the AABBs", "", "", "", "1"] +
                    [number(report["kinds"][kind]["fit_ratio"], 1) if kind in passes else "-" for kind in order])
        for processor, ms in (by_name(TABLE_5, scene) or {}).items():
            codes, sort, nodes, *volumes = [number(value, 2) for value in ms]
            rows.append([f"  published, {processor}", codes, sort, nodes, ""] + volumes + [""] * (len(order) - 3))
    print_table("Table 5: device time of each pass in ms (published on other machines; > 1 min or not given: -)", rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", type=pathlib.Path, help="folder of .glb scenes")
    parser.add_argument("--reports", type=pathlib.Path, default=pathlib.Path("output"),
                        help="folder for reports (default: output)")
    parser.add_argument("--reuse", action="store_true", help="read the reports that are there already")
    parser.add_argument("--only", default="", help="scenes whose names hold this")
    parser.add_argument("--bounds", default="all", help="kinds, as boxwood quality takes them (default: all)")
    root = pathlib.Path(__file__).resolve().parent.parent
    parser.add_argument("--tool", type=pathlib.Path, default=root / "build/release/boxwood",
                        help="the tool (default: of the release build)")
    arguments = parser.parse_args()
    scenes = sorted(file for file in arguments.scenes.glob("*.glb") if arguments.only in file.name)
    if not scenes:
        sys.exit(f"reproduce_tables: no .glb scene in {arguments.scenes}")
    if not arguments.tool.exists():
        sys.exit(f"reproduce_tables: no tool at {arguments.tool}; build it, or name it by --tool")
    arguments.reports.mkdir(parents=True, exist_ok=True)
    reports = {scene.stem: make_report(arguments, scene) for scene in scenes}
    reports = {scene: report for scene, report in reports.items() if report is not None}
    if not reports:
        sys.exit("reproduce_tables: no scene could be measured")
    table_4(reports)
    table_5(reports)


if __name__ == "__main__":
    main()
