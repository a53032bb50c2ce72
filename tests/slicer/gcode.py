"""What a printer makes of a project: PrusaSlicer slices it, and its extrusions are weighed."""
import dataclasses
import pathlib
import re
import subprocess

import numpy as np

FILAMENT_AREA = np.pi * 1.75**2 / 4  # mm², as the projects say
LAYER = 0.2  # mm
HALF_BRIDGE = 2.5 + 0.5  # mm, and the pixels' diagonal
# What is taken off, and what is not printed.
BESIDES = {"Support material", "Support material interface", "Skirt/Brim", "Custom"}


@dataclasses.dataclass
class Extrusions:
    """Straight segments in the order in which they are printed; mm."""
    kind: np.ndarray  # n texts, as PrusaSlicer calls them
    start: np.ndarray  # n×3; z is the top of the layer
    end: np.ndarray
    volume: np.ndarray  # n, mm³

    def where(self, chosen):
        return Extrusions(self.kind[chosen], self.start[chosen], self.end[chosen],
                          self.volume[chosen])

    def of_the_body(self):
        return self.where(~np.isin(self.kind, list(BESIDES)))

    def support(self):
        return self.where(np.char.startswith(self.kind, "Support"))

    def middles(self):
        """n×3, half a layer below its top."""
        return 0.5 * (self.start + self.end) - [0, 0, LAYER / 2]

    def mass(self, density):
        """Grams; density in g/cm³."""
        return density * self.volume.sum() / 1000

    def centre(self):
        return (self.volume[:, None] * self.middles()).sum(0) / self.volume.sum()


def reaches(extrusions, cavity):
    """Of all that is printed within the box around the cavity's vertices: how far what is printed
    below is, support too, mm, at most 6; and the area for which it is farther than that."""
    pixel, most = 0.25, 24
    low = cavity.min(0)
    shape = np.ceil(np.ptp(cavity, axis=0)[:2] / pixel).astype(int) + 2 * most

    def image_of(segments):
        image = np.zeros(shape, bool)
        for share in np.linspace(0, 1, 80):
            at = (1 - share) * segments.start[:, :2] + share * segments.end[:, :2]
            place = np.floor((at - low[:2]) / pixel).astype(int) + most
            place = place[((place >= 0) & (place < shape)).all(1)]
            image[place[:, 0], place[:, 1]] = True
        return image

    body, support = extrusions.of_the_body(), extrusions.support()
    layer = np.round(body.end[:, 2] / LAYER).astype(int)
    below, areas = None, np.zeros(most)
    for k in range(layer.min(), layer.max() + 1):
        image = image_of(body.where(layer == k))
        inner = image[most:-most, most:-most]
        if below is not None and low[2] < k * LAYER < cavity[:, 2].max() + 2 * LAYER:
            # Support ends a gap below what it carries.
            height = support.end[:, 2] - k * LAYER
            reached = below | image_of(support.where((height < 0) & (height > -3.5 * LAYER)))
            steps = 0
            # Rings around, by turns with four and with eight neighbours.
            while steps < most:
                left = (inner & ~reached[most:-most, most:-most]).sum()
                if left == 0:
                    break
                areas[steps] += left * pixel**2
                steps += 1
                grown = reached.copy()
                grown[1:] |= reached[:-1]
                grown[:-1] |= reached[1:]
                grown[:, 1:] |= reached[:, :-1]
                grown[:, :-1] |= reached[:, 1:]
                if steps % 2:
                    grown[1:, 1:] |= reached[:-1, :-1]
                    grown[1:, :-1] |= reached[:-1, 1:]
                    grown[:-1, 1:] |= reached[1:, :-1]
                    grown[:-1, :-1] |= reached[1:, 1:]
                reached = grown
        below = image
    return pixel * np.arange(most), areas


def slice_project(project, gcode):
    """Runs PrusaSlicer without a window."""
    done = subprocess.run(["prusa-slicer", "--export-gcode", "--dont-arrange", "--loglevel", "1",
                           project, "--output", gcode],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0 or not pathlib.Path(gcode).exists():
        raise RuntimeError(done.stdout.decode()[-2000:])
    return read(gcode)


def read(path):
    at = np.zeros(3)
    filament = 0.0  # where its axis stands
    is_relative = False
    kind = "Custom"
    kinds, starts, ends, lengths = [], [], [], []
    word = re.compile(r"([XYZE])([-+.\d]+)")
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        if line.startswith(";TYPE:"):
            kind = line[6:].strip()
        code = line.split(";", 1)[0]
        words = {letter: float(value) for letter, value in word.findall(code)}
        if code.startswith(("M82", "M83")):
            is_relative = code.startswith("M83")
        elif code.startswith("G92"):
            filament = words.get("E", filament)
        elif code.startswith(("G0 ", "G1 ")):
            to = np.array([words.get(axis, at[i]) for i, axis in enumerate("XYZ")])
            fed = words.get("E", 0.0 if is_relative else filament)
            if not is_relative:
                fed, filament = fed - filament, fed
            # Filament that comes without a move only comes back after a retraction.
            if fed > 0 and (to[:2] != at[:2]).any():
                kinds.append(kind)
                starts.append(at)
                ends.append(to)
                lengths.append(fed)
            at = to
    return Extrusions(np.array(kinds), np.array(starts), np.array(ends),
                      FILAMENT_AREA * np.array(lengths))
