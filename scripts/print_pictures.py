#!/usr/bin/python3
"""Draws what PrusaSlicer makes of a project: the extrusions cut through along the vertical plane
of the project's thumbnail, and one layer of them. Writes <prefix>_cut.png (the thumbnail),
<prefix>_gcode_cut.png and <prefix>_layer.png.

usage: scripts/print_pictures.py <project.3mf> <file.gcode> <prefix> [height of the layer, mm]
"""
import pathlib
import re
import sys
import zipfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "slicer"))
import gcode  # noqa: E402

SIZE = 512  # pixels
MARGIN = 0.03
COLOURS = {"perimeter": (96, 132, 176), "dense": (242, 168, 64), "infill": (143, 128, 194),
           "support": (120, 178, 120)}


def colour_of(kind):
    if "perimeter" in kind.lower():
        return COLOURS["perimeter"]
    if kind.startswith(("Support", "Skirt")):
        return COLOURS["support"]
    return COLOURS["infill" if kind == "Internal infill" else "dense"]


def widths(extrusions):
    """Of the lines: a rectangle with round ends has the cross-section h (w - h) + pi h²/4."""
    length = np.linalg.norm(extrusions.end - extrusions.start, axis=1)
    return extrusions.volume / (length * gcode.LAYER) + gcode.LAYER * (1 - np.pi / 4)


class Canvas:
    """A square picture of a region of the plane, in which capsules are drawn."""

    def __init__(self, least, most):
        side = (1 + 2 * MARGIN) * max(most - least)
        self.scale = SIZE / side
        self.origin = 0.5 * (least + most) - 0.5 * side
        self.pixels = np.full((SIZE, SIZE, 3), 255.0)

    def capsule(self, start, end, radius, colour):
        a, b = ((np.asarray(p) - self.origin) * self.scale for p in (start, end))
        r = radius * self.scale
        low = np.maximum(np.floor(np.minimum(a, b) - r - 1), 0).astype(int)
        high = np.minimum(np.ceil(np.maximum(a, b) + r + 1), SIZE).astype(int)
        if (high <= low).any():
            return
        x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
        p = np.stack([x, y], axis=-1) - a
        along = b - a
        t = np.clip((p @ along) / max(along @ along, 1e-12), 0, 1)[..., None]
        distance = np.linalg.norm(p - t * along, axis=-1)
        # Darker towards the border, so that lines are told apart; smooth over a pixel.
        cover = np.clip(r - distance + 0.5, 0, 1)[..., None]
        shade = 1 - 0.35 * np.clip(distance / max(r, 1e-9), 0, 1)[..., None] ** 4
        part = self.pixels[low[1]:high[1], low[0]:high[0]]
        part += cover * (shade * np.array(colour) - part)

    def write(self, path):
        image = vtkImageData()
        image.SetDimensions(SIZE, SIZE, 1)
        image.GetPointData().SetScalars(
            numpy_to_vtk(self.pixels.round().astype(np.uint8).reshape(-1, 3), deep=True))
        writer = vtkPNGWriter()
        writer.SetFileName(str(path))
        writer.SetInputData(image)
        writer.Write()


def draw_cut(extrusions, centre, path):
    body = extrusions.of_the_body()
    extent = np.ptp(np.concatenate([body.start, body.end]), axis=0)
    # As the thumbnail: the wider side is seen, from -y or from +x.
    away = 0 if extent[1] > extent[0] else 1
    across = 1 - away
    canvas = Canvas(*(f(np.concatenate([body.start, body.end]), axis=0)[[across, 2]]
                      for f in (np.min, np.max)))
    before = extrusions.start[:, away] - centre[away]
    after = extrusions.end[:, away] - centre[away]
    for i in np.flatnonzero(before * after < 0):
        at = extrusions.start[i] + before[i] / (before[i] - after[i]) * (
            extrusions.end[i] - extrusions.start[i])
        way = extrusions.end[i] - extrusions.start[i]
        wide = widths(extrusions.where([i]))[0] * np.linalg.norm(way) / abs(way[away])
        half = min(0.5 * wide, 4.0) - gcode.LAYER / 2
        place = np.array([at[across], at[2] - gcode.LAYER / 2])
        canvas.capsule(place - [half, 0], place + [half, 0], gcode.LAYER / 2,
                       colour_of(extrusions.kind[i]))
    canvas.write(path)


def draw_layer(extrusions, height, path):
    tops = np.unique(extrusions.of_the_body().end[:, 2].round(3))
    top = tops[np.abs(tops - height).argmin()]
    layer = extrusions.where(np.abs(extrusions.end[:, 2] - top) < 1e-3)
    ends = np.concatenate([layer.start, layer.end])[:, :2]
    canvas = Canvas(ends.min(0), ends.max(0))
    for i, width in enumerate(widths(layer)):
        canvas.capsule(layer.start[i, :2], layer.end[i, :2], width / 2, colour_of(layer.kind[i]))
    canvas.write(path)


def main(project, code, prefix, height=None):
    with zipfile.ZipFile(project) as archive:
        pathlib.Path(f"{prefix}_cut.png").write_bytes(archive.read("Metadata/thumbnail.png"))
        report = archive.read("Metadata/report.txt").decode()
    centre = np.array(re.search(r"print_center_of_mass = \((.*)\)", report)[1].split(","), float)
    extrusions = gcode.read(code)
    draw_cut(extrusions, centre, f"{prefix}_gcode_cut.png")
    draw_layer(extrusions, centre[2] if height is None else float(height), f"{prefix}_layer.png")


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    main(*sys.argv[1:])
