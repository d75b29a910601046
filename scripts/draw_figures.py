#!/usr/bin/python3
"""Draws the pictures of docs/figures/ from what the examples figure3 and pictures wrote. Called by scripts/figures.

usage: draw_figures.py INPUT_FOLDER OUTPUT_FOLDER
"""

import csv
import sys
import xml.etree.ElementTree
from itertools import combinations, product
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

POSITIVE, NEGATIVE = np.array([0.93, 0.45, 0.13]), np.array([0.16, 0.44, 0.71])
LIGHT = np.array([0.35, -0.6, 0.72])


def read_surface(path):
    """The points, triangles and values of a file of WriteSphericalPlot."""
    piece = xml.etree.ElementTree.parse(path).getroot().find("PolyData/Piece")

    def numbers(place):
        return np.array(piece.find(place).text.split(), dtype=float)

    points = numbers("Points/DataArray").reshape(-1, 3)
    triangles = numbers("Polys/DataArray").astype(int).reshape(-1, 3)
    return points, triangles, numbers("PointData/DataArray")


def empty_axes(figure, place, reach):
    axes = figure.add_subplot(*place, projection="3d")
    axes.set_axis_off()
    axes.set_proj_type("ortho")
    axes.set_box_aspect((1, 1, 1), zoom=1.55)
    for set_limits in (axes.set_xlim, axes.set_ylim, axes.set_zlim):
        set_limits(-reach, reach)
    axes.view_init(elev=22, azim=35)
    return axes


def draw_surface(axes, path, reach):
    points, triangles, values = read_surface(path)
    for axis in np.eye(3):
        axes.plot(*zip(-reach * axis, reach * axis), color="0.75", linewidth=0.6, zorder=0)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    # What is close to the origin has no area to speak of.
    keep = lengths[:, 0] > 1e-9
    normals = normals[keep] / lengths[keep]
    # The light comes with the viewer.
    azimuth = np.radians(35)
    turn = np.array([[np.cos(azimuth), -np.sin(azimuth), 0], [np.sin(azimuth), np.cos(azimuth), 0], [0, 0, 1]])
    shade = 0.45 + 0.55 * np.clip(normals @ (turn @ (LIGHT / np.linalg.norm(LIGHT))), 0, 1)
    sign = values[triangles[keep]].sum(axis=1) > 0
    colors = np.where(sign[:, None], POSITIVE, NEGATIVE) * shade[:, None]
    axes.add_collection3d(Poly3DCollection(corners[keep], facecolors=colors, edgecolors=colors, linewidths=0.15))


def draw_basis(folder, output):
    figure = plt.figure(figsize=(14, 2.4))
    figure.subplots_adjust(left=0, right=1, wspace=0)
    for m in range(-3, 4):
        axes = empty_axes(figure, (1, 7, m + 4), 0.72)
        draw_surface(axes, folder / f"basis_{m}.vtp", 0.7)
        axes.set_title(f"$Y_{{3,{m}}}$", y=1.02)
    save(figure, output / "basis.png")


def draw_reference(folder, output):
    figure = plt.figure(figsize=(9, 3.2))
    figure.subplots_adjust(left=0, right=1, wspace=0)
    titles = {"reference": r"reference $\tilde a = Y_{3,-2}$", "rotated": "a rotation of it",
              "hexadecapole": "the reference of degree 4"}
    for i, (name, title) in enumerate(titles.items()):
        axes = empty_axes(figure, (1, 3, i + 1), 0.7)
        draw_surface(axes, folder / f"{name}.vtp", 0.7)
        axes.set_title(title, y=0.98)
    save(figure, output / "reference.png")


def draw_zones(folder, output):
    with open(folder / "zone_vertices.csv") as file:
        rows = [[float(number) for number in row] for row in list(csv.reader(file))[1:]]
    vertices = np.array([row[:3] for row in rows])
    classes = [int(row[3]) for row in rows]
    figure = plt.figure(figsize=(6.4, 6))
    axes = empty_axes(figure, (1, 1, 1), 1)
    axes.view_init(elev=20, azim=28)
    eye = np.array([np.cos(np.radians(20)) * np.cos(np.radians(28)), np.cos(np.radians(20)) * np.sin(np.radians(28)),
                    np.sin(np.radians(20))])

    def normals_of(face_normals, distances, point):
        return [n for n, d in zip(face_normals, distances) if abs(n @ point - d) < 1e-5]

    def draw_edges(points, face_normals, distances, color):
        for a, b in combinations(points, 2):
            shared = normals_of(face_normals, distances, (a + b) / 2)
            if len(shared) < 2:
                continue
            hidden = all(n @ eye < 0 for n in shared)
            axes.add_collection3d(Line3DCollection([[a, b]], colors=color, linewidths=0.8 if hidden else 1.8,
                                                   linestyles="dotted" if hidden else "solid"))

    triangles = [np.array(signs) / np.sqrt(3) for signs in product([-1, 1], repeat=3)]
    octagons = [sign * axis for axis in np.eye(3) for sign in (-1, 1)]
    tips = [sign * axis for axis in np.eye(3) for sign in (-1, 1)]
    draw_edges(tips, triangles, [1 / np.sqrt(3)] * 8, "0.6")
    draw_edges(vertices, triangles + octagons, [1 / np.sqrt(3)] * 8 + [np.sqrt(2) - 1] * 6, "black")
    axes.scatter(*np.array(tips).T, s=70, color="0.45", depthshade=False, label="octahedron: all one, $-\\tilde a$")
    palette = ["tab:red", "tab:orange", "gold", "tab:green", "tab:blue", "tab:purple"]
    hidden = [all(n @ eye < 0 for n in normals_of(triangles + octagons, [1 / np.sqrt(3)] * 8 + [np.sqrt(2) - 1] * 6, v))
              for v in vertices]
    axes.scatter(*vertices.T, s=[22 if h else 60 for h in hidden], color=[palette[c] for c in classes], depthshade=False,
                 label="truncated cube: glued vertices share a colour")
    axes.legend(loc="lower center", frameon=False, bbox_to_anchor=(0.5, -0.1))
    save(figure, output / "zones.png")


def draw_figure3(folder, output):
    with open(folder / "figure3.csv") as file:
        columns = {name: [] for name in next(csv.reader([file.readline()]))}
        for row in csv.reader(file):
            for name, number in zip(columns, row):
                columns[name].append(float(number))
    figure, axes = plt.subplots(figsize=(7, 4.4))
    for name, color, label in (("sqrt_penalty", "tab:blue", r"$\sqrt{p}$"), ("distance", "tab:red", "distance")):
        axes.semilogy(columns["iteration"], columns["paper_" + name], "o", markerfacecolor="none", color=color,
                      label=f"{label}, the paper's")
        axes.semilogy(columns["iteration"], columns[name], color=color, label=f"{label}, w2 = 0.46193")
        axes.semilogy(columns["iteration"], columns["stated_" + name], ":", color=color,
                      label=f"{label}, w2 = 2.5 and its best step")
    axes.set_xlabel("iteration")
    axes.set_xticks(range(0, 21, 2))
    axes.grid(color="0.9")
    axes.legend(frameon=False, fontsize=8)
    save(figure, output / "figure3.png")


def save(figure, path):
    figure.savefig(path, dpi=110, bbox_inches="tight", pad_inches=0.05, metadata={"Software": None})
    plt.close(figure)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, output = Path(sys.argv[1]), Path(sys.argv[2])
    draw_basis(folder, output)
    draw_reference(folder, output)
    draw_zones(folder, output)
    draw_figure3(folder, output)


main()
