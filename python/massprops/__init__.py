"""Hollows 3D models so that their prints stand, spin, float, hang, roll upright or weigh what they should.

    import massprops
    result = massprops.hollow(vertices, faces, goal="Stand", inner_lower_bound=1.2)
    result.report["tip_angle_after"], result.cavity.vertices, result.solid.faces

`hollow` says what it takes, `parameters()` lists all parameters, and docs/report.md explains the keys of the
report.
"""
import dataclasses
import difflib
import textwrap

import numpy as np

from . import _massprops
from ._massprops import InvalidInput, __version__

__all__ = ["ColouredMesh", "InvalidInput", "Mesh", "Model", "Result", "hollow", "parameters",
           "set_thread_count"]

InvalidInput.__module__ = __name__
InvalidInput.__doc__ = "The model or a parameter is refused; the text says why and what to do."

# What is an argument of its own here.
_OTHERWISE = {"show_layers": "pictures", "keep_selected_solid": "keep_solid"}


@dataclasses.dataclass(frozen=True)
class Mesh:
    """A triangle mesh."""

    vertices: np.ndarray  #: n×3, float64
    faces: np.ndarray  #: m×3, int32, indices of vertices

    def __iter__(self):
        """vertices, faces = mesh"""
        return iter((self.vertices, self.faces))


@dataclasses.dataclass(frozen=True)
class ColouredMesh(Mesh):
    """A mesh with a colour for every vertex."""

    name: str
    colours: np.ndarray  #: n×3, uint8: red, green, blue


@dataclasses.dataclass(frozen=True)
class Result:
    """What came out, in the model's own coordinates."""

    #: The surface of the cavity, normals pointing into it; without faces when nothing can be hollowed.
    cavity: Mesh
    #: Distance of every vertex of the cavity from the outer surface.
    wall: np.ndarray
    #: The outer surface: the model as it was given or, where it was mended or moved, as it is now.
    outer: Mesh
    #: Whether `outer` is another surface than the model.
    outer_changed: bool
    #: With `drain_holes`: outer surface and cavity joined by the holes; None where nothing was drilled.
    drilled: "Mesh | None"
    #: The plugs for the holes, or None.
    plugs: "Mesh | None"
    #: With `pictures`: the model cut open, the marks, and the skeleton.
    pictures: tuple
    #: The keys of docs/report.md: bool, int, float, str, or arrays of 3 and 3×3.
    report: dict

    @property
    def solved(self):
        """Whether the goal is reached."""
        return self.report["solved"]

    @property
    def solid(self):
        """Outer surface and cavity in one mesh, which bounds the material: with drain holes the drilled body;
        not merged along the rims of an open surface."""
        if self.drilled is not None:
            return self.drilled
        return Mesh(np.concatenate([self.outer.vertices, self.cavity.vertices]),
                    np.concatenate([self.outer.faces,
                                    self.cavity.faces + np.int32(len(self.outer.vertices))]))


def parameters():
    """All parameters of `hollow`, a dictionary each: name, type, default, label, unit, help, entries of a
    choice, the goals for which it counts (none: all), category, and whether it is advanced."""
    return [row for row in _massprops.parameters() if row["name"] not in _OTHERWISE]


def set_thread_count(count):
    """How many threads a run may use, at first one a core and at most 8. No result depends on it. Batches
    that run a process for each core want 1."""
    if count < 1:
        raise InvalidInput("The number of threads must be at least 1.")
    _massprops.set_thread_count(count)


def _points(vertices):
    points = np.asarray(vertices)
    if points.ndim != 2 or points.shape[1] != 3:
        raise InvalidInput(f"vertices must be an array of n points with 3 coordinates each, not of shape "
                           f"{points.shape}.")
    if points.dtype.kind not in "iuf":
        raise InvalidInput(f"vertices must be numbers, not {points.dtype}.")
    return np.ascontiguousarray(points, dtype=np.float64)


def _triangles(faces, count):
    triangles = np.asarray(faces)
    if triangles.size == 0:
        return np.zeros((0, 3), np.int32)
    if triangles.ndim != 2 or triangles.shape[1] != 3:
        raise InvalidInput(f"faces must be an array of m triangles with 3 indices each, not of shape "
                           f"{triangles.shape}: cut larger faces into triangles.")
    if triangles.dtype.kind not in "iu":
        raise InvalidInput(f"faces must be whole numbers, the indices of vertices, not {triangles.dtype}.")
    if triangles.min() < 0 or triangles.max() >= count:
        raise InvalidInput(f"faces must be indices of vertices, 0 to {count - 1}, but there are some from "
                           f"{triangles.min()} to {triangles.max()}.")
    return np.ascontiguousarray(triangles, dtype=np.int32)


def _kept(keep_solid, count):
    if keep_solid is None:
        return []
    kept = np.asarray(keep_solid)
    if kept.dtype.kind == "b" and kept.shape == (count,):
        kept = np.flatnonzero(kept)
    if kept.ndim != 1 or kept.size == 0 or kept.dtype.kind not in "iu" \
            or kept.min() < 0 or kept.max() >= count:
        raise InvalidInput(f"keep_solid must be indices of some faces, or a truth value for each of the "
                           f"{count} faces.")
    return kept.tolist()


def _require_known(given):
    known = {row["name"] for row in parameters()}
    for name in given:
        if name in _OTHERWISE:
            raise TypeError(f"hollow() has no parameter '{name}': it is '{_OTHERWISE[name]}' here")
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise TypeError(f"hollow() has no parameter '{name}'"
                            + (f": is it '{near[0]}'?" if near else ""))


class Model:
    """A model for several runs, `hollow` with other parameters each time. What a run has in common with the one
    before is not found out again: the checked or mended model for another goal or wall, where a cavity may be for
    another goal with the same wall, the skeleton for any other offset surface. Results are those of
    `massprops.hollow`, bit for bit. Runs of several threads wait for each other."""

    def __init__(self, vertices, faces, *, single_precision=False):
        """As for `massprops.hollow`; later changes of the arrays do not count."""
        points = _points(vertices)
        self._faces = _triangles(faces, len(points)).copy()
        self._vertices = points.astype(np.float32).astype(np.float64) if single_precision else points.copy()
        self._model = _massprops.Model(points, self._faces, bool(single_precision))

    def hollow(self, *, keep_solid=None, pictures=False, progress=None, **parameters):
        """As `massprops.hollow` of this model."""
        _require_known(parameters)
        wishes = dict(parameters, show_layers=bool(pictures))
        cavity, wall, outer, drilled, plugs, drawn, report = self._model.hollow(
            wishes, _kept(keep_solid, len(self._faces)), progress)
        return Result(cavity=Mesh(*cavity), wall=wall,
                      outer=Mesh(self._vertices, self._faces) if outer is None else Mesh(*outer),
                      outer_changed=outer is not None,
                      drilled=None if drilled is None else Mesh(*drilled),
                      plugs=None if plugs is None else Mesh(*plugs),
                      pictures=tuple(ColouredMesh(v, f, name, c) for name, v, f, c in drawn), report=report)


def hollow(vertices, faces, *, single_precision=False, **wishes):
    """Finds the cavity with which a model reaches its goal. Same input, same result, bit for bit.

    vertices: n×3, lengths read as millimetres, the up axis is +z unless `up_axis` says otherwise.
    faces: m×3 indices of vertices, counter-clockwise seen from outside.
    keep_solid: faces near which all stays solid to `solid_depth`: indices, or a truth value for each.
    pictures: whether the result brings the model cut open, the marks of the goal, and the skeleton.
    single_precision: whether all coordinates shall be numbers of single precision, as STL files keep them;
        what is checked and reported is then what such a file holds.
    progress: called, several times a second, with a percentage and the name of a stage; what it raises ends the
        run at once.
    parameters: those below, of which None keeps the default; a length is a number in the model's units or a
        share of the diagonal as in "1.5%".

    Returns a Result; a goal that is missed is no error but result.solved == False. Raises InvalidInput, a
    ValueError, when the model or a parameter is refused, and RuntimeError when a stage fails on the model.
    Other threads of Python go on meanwhile. For several goals or walls of one model: `Model`."""
    return Model(vertices, faces, single_precision=single_precision).hollow(**wishes)


def _with_parameters(text):
    lines = [text, ""]
    for row in parameters():
        unit = f" [{row['unit']}]" if row["unit"] else ""
        entries = f" Entries: {', '.join(row['entries'])}." if len(row["entries"]) > 1 else ""
        lines += textwrap.wrap(f"{row['name']}: {row['type']} = {row['default']!r}{unit}. {row['help']}"
                               f"{entries}", 105, initial_indent="    ", subsequent_indent="        ")
    return "\n".join(lines)


hollow.__doc__ = _with_parameters(hollow.__doc__)
