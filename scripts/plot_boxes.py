#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the files of `boxwood info --boxes` side by side: the boxes of a tree as lines, seen by the file's camera.

    scripts/plot_boxes.py aabb.glb obb-moments.glb -o boxes.png

The name of each file is the title of its part. Lines fade with their distance. Needs matplotlib (Debian:
python3-matplotlib; scripts/setup.sh --checks installs it).
"""
import argparse
import json
import pathlib
import struct
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402
from matplotlib.collections import LineCollection  # noqa: E402

NEAR, FAR = numpy.array([0.05, 0.25, 0.45]), numpy.array([0.82, 0.88, 0.93])


def read_glb(file):
    """The document of a binary glTF file and the bytes of its buffer."""
    data = pathlib.Path(file).read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + length]), data[28 + length:]


def values(document, buffer, index):
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    kind = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
    width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return numpy.frombuffer(buffer, kind, accessor["count"] * width, start).reshape(-1, width)


def matrix_of(node):
    return numpy.array(node.get("matrix", numpy.eye(4).ravel())).reshape(4, 4).T


def read_lines(file):
    """Both ends of every line, as seen by the first camera: (lines, 2, 3). Ends the program where it is none."""
    try:
        document, buffer = read_glb(file)
        camera = next(node for node in document["nodes"] if "camera" in node)
        to_view = numpy.linalg.inv(matrix_of(camera))
        lines = []
        for node in document["nodes"]:
            for primitive in document["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
                if primitive.get("mode") != 1:
                    raise ValueError("has triangles")
                points = values(document, buffer, primitive["attributes"]["POSITION"])
                seen = numpy.c_[points, numpy.ones(len(points))] @ (to_view @ matrix_of(node)).T
                lines.append(seen[values(document, buffer, primitive["indices"]).reshape(-1, 2), :3])
        return numpy.concatenate(lines)
    except (OSError, ValueError, KeyError, IndexError, StopIteration, struct.error) as error:
        sys.exit(f"plot_boxes: {file}: not a file of boxwood info --boxes ({error!r})")


def plot(axes, lines, title):
    lines = lines[(lines[:, :, 2] < 0).all(axis=1)]  # before the camera
    lines = lines[numpy.argsort(lines[:, :, 2].mean(axis=1))]
    depth = lines[:, :, 2].mean(axis=1)
    nearness = (depth - depth.min()) / max(numpy.ptp(depth), 1e-30)
    colours = FAR + nearness[:, None] * (NEAR - FAR)
    axes.add_collection(LineCollection(lines[:, :, :2] / -lines[:, :, 2:], colors=colours, linewidths=0.6))
    axes.autoscale()
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(title, fontsize=11, fontweight="bold")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("boxes", nargs="+", help="files of boxwood info --boxes (.glb)")
    parser.add_argument("-o", "--output", required=True,
                        help="picture to write; its ending says the kind (.png, .svg, .pdf)")
    arguments = parser.parse_args()
    scenes = [(pathlib.Path(file).stem, read_lines(file)) for file in arguments.boxes]

    figure, row = plt.subplots(1, len(scenes), figsize=(5.4 * len(scenes), 5), squeeze=False, layout="constrained",
                               sharex=True, sharey=True)
    for axes, (name, lines) in zip(row[0], scenes):
        plot(axes, lines, name)
    try:
        figure.savefig(arguments.output, dpi=72)
    except (OSError, ValueError) as error:
        sys.exit(f"plot_boxes: {arguments.output}: {error}")


if __name__ == "__main__":
    main()
