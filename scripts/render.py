#!/usr/bin/python3
"""Renders a picture of a run: the solid before on the left, the hollowed body after on the right,
both cut open by the same vertical plane, with centre of mass, plumb line and contact area. With
--outer alone: a picture of the model from outside.

Needs VTK 9 (Debian: python3-vtk9) and a display; without one run it under `xvfb-run -a`.
"""
import argparse
import os

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

SIZE = (1600, 1000)
OUTSIDE_SIZE = (800, 700)
BACKGROUND = (1.0, 1.0, 1.0)
GROUND = (0.93, 0.93, 0.92)
OUTER = (0.62, 0.72, 0.80)
MATERIAL = (0.95, 0.66, 0.25)
CAVITY = (0.56, 0.50, 0.76)
BEFORE = (0.80, 0.10, 0.10)
AFTER = (0.05, 0.50, 0.15)
CONTACT = (0.05, 0.30, 0.75)
WATER = (0.15, 0.50, 0.75)
INK = (0.13, 0.13, 0.15)

UP_AXES = ("+Z", "+Y", "+X", "-Z", "-Y", "-X")


# ---------------------------------------------------------------- reading


def read_mesh(path):
    """Vertices and faces of a PLY file; None when there is no such mesh or it has no faces."""
    if not path or not os.path.isfile(path):
        return None
    reader = vtk.vtkPLYReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    if data.GetNumberOfPolys() == 0:
        return None
    vertices = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    faces = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(np.int64)
    return vertices, faces


def read_report(path):
    """The `key = value` lines: numbers, tuples and truth values are converted, the rest is text."""
    report = {}
    if not path or not os.path.isfile(path):
        return report
    with open(path, encoding="utf-8") as file:
        for line in file:
            key, separator, value = line.strip().partition(" = ")
            if separator:
                report[key] = parse_value(value.strip())
    return report


def parse_value(text):
    if text in ("true", "false"):
        return text == "true"
    numbers = text.replace("(", " ").replace(")", " ").replace(",", " ").split()
    try:
        values = [float(number) for number in numbers]
    except ValueError:
        return text
    if text.startswith("((") and len(values) == 9:
        return np.array(values).reshape(3, 3)
    if text.startswith("("):
        return np.array(values)
    return values[0] if len(values) == 1 else text


# ---------------------------------------------------------------- geometry


def up_rotation(name):
    """Rotation that takes the named axis to +z."""
    axis = "XYZ".index(name[1])
    if name[0] == "+":
        # A cyclic exchange of the axes.
        return np.roll(np.eye(3), axis + 1, axis=1) if axis != 2 else np.eye(3)
    flip = np.diag([1.0, -1.0, -1.0])  # half a turn about x
    return flip @ up_rotation("+" + name[1])


def signed_volume(mesh):
    a, b, c = (mesh[0][mesh[1][:, i]] for i in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def volume_centroid(mesh):
    origin = mesh[0].mean(axis=0)
    a, b, c = (mesh[0][mesh[1][:, i]] - origin for i in range(3))
    weights = np.einsum("ij,ij->i", a, np.cross(b, c))
    return origin + (weights[:, None] * (a + b + c)).sum(axis=0) / (4 * weights.sum())


def convex_hull(points):
    """Counter-clockwise corners of the convex hull of points in the plane."""
    points = sorted(map(tuple, np.unique(points, axis=0)))
    if len(points) < 3:
        return np.array(points)

    def chain(sequence):
        hull = []
        for p in sequence:
            while len(hull) > 1:
                (ax, ay), (bx, by) = hull[-2:]
                if (bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 0:
                    break
                hull.pop()
            hull.append(p)
        return hull[:-1]

    return np.array(chain(points) + chain(points[::-1]))


def contact_patches(mesh, diagonal):
    """Convex hull of all ground contacts, and the triangles that lie on the ground."""
    vertices, faces = mesh
    on_ground = vertices[:, 2] <= vertices[:, 2].min() + 1e-4 * diagonal
    return convex_hull(vertices[on_ground, :2]), faces[on_ground[faces].all(axis=1)]


def polygon_centre(polygon):
    if len(polygon) < 3:
        return polygon.mean(axis=0)
    following = np.roll(polygon, -1, axis=0)
    cross = polygon[:, 0] * following[:, 1] - polygon[:, 1] * following[:, 0]
    return ((polygon + following) * cross[:, None]).sum(axis=0) / (3 * cross.sum())


def cut_direction(mesh, before, pivot, diagonal):
    """Horizontal direction of the cut: where the solid falls to or, if that says little, along its
    greatest width. The camera sees it point to the right."""
    lean = before[:2] - pivot
    if np.linalg.norm(lean) > 5e-3 * diagonal:
        return lean / np.linalg.norm(lean)
    angles = np.radians(np.arange(0, 180, 5))
    directions = np.c_[np.cos(angles), np.sin(angles)]
    widths = np.ptp(mesh[0][:, :2] @ directions.T, axis=0)
    return directions[widths.argmax()]


def vertical_principal_axis(inertia):
    """The principal axis that is nearest to the vertical, pointing up."""
    axes = np.linalg.eigh(inertia)[1]
    axis = axes[:, np.abs(axes[2]).argmax()]
    return axis if axis[2] > 0 else -axis


# ---------------------------------------------------------------- VTK pieces


def poly_data(vertices, faces):
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(vertices, dtype=float), deep=True))
    cells = vtk.vtkCellArray()
    table = np.c_[np.full(len(faces), 3), faces].astype(np.int64).ravel()
    cells.SetCells(len(faces), numpy_to_vtkIdTypeArray(table, deep=True))
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def with_normals(data):
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(data)
    normals.SetFeatureAngle(50)
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def clipped(data, plane):
    clip = vtk.vtkClipPolyData()
    clip.SetInputData(data)
    clip.SetClipFunction(plane)
    clip.InsideOutOn()
    clip.Update()
    return clip.GetOutput()


def section(meshes, plane):
    """The filled cross-section of the body that the closed surfaces bound together."""
    append = vtk.vtkAppendPolyData()
    for mesh in meshes:
        append.AddInputData(poly_data(*mesh))
    # The closed-surface filter keeps the side that the normal points to.
    kept = vtk.vtkPlane()
    kept.SetOrigin(plane.GetOrigin())
    kept.SetNormal(*(-np.array(plane.GetNormal())))
    planes = vtk.vtkPlaneCollection()
    planes.AddItem(kept)
    clip = vtk.vtkClipClosedSurface()
    clip.SetInputConnection(append.GetOutputPort())
    clip.SetClippingPlanes(planes)
    clip.SetScalarModeToLabels()
    clip.TriangulationErrorDisplayOff()
    clip.Update()
    caps = vtk.vtkThreshold()
    caps.SetInputConnection(clip.GetOutputPort())
    caps.SetInputArrayToProcess(0, 0, 0, 1, "Labels")
    caps.SetLowerThreshold(1)
    caps.SetUpperThreshold(1)
    surface = vtk.vtkGeometryFilter()
    surface.SetInputConnection(caps.GetOutputPort())
    surface.Update()
    return surface.GetOutput()


def outline(data, plane):
    """The lines in which a surface meets the plane."""
    cutter = vtk.vtkCutter()
    cutter.SetInputData(data)
    cutter.SetCutFunction(plane)
    stripper = vtk.vtkStripper()
    stripper.SetInputConnection(cutter.GetOutputPort())
    stripper.Update()
    return stripper.GetOutput()


def actor(data, color, ambient=0.0, diffuse=1.0, specular=0.0, lit=True):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    surface = result.GetProperty()
    surface.SetColor(color)
    surface.SetAmbient(ambient)
    surface.SetDiffuse(diffuse)
    surface.SetSpecular(specular)
    surface.SetSpecularPower(30)
    surface.SetLighting(lit)
    return result


def line_actor(data, color, width):
    result = actor(data, color, lit=False)
    result.GetProperty().SetLineWidth(width)
    result.GetProperty().SetRenderLinesAsTubes(False)
    return result


def segment(a, b):
    source = vtk.vtkLineSource()
    source.SetPoint1(*a)
    source.SetPoint2(*b)
    source.Update()
    return source.GetOutput()


def dashes(a, b, length):
    a, b = np.asarray(a, float), np.asarray(b, float)
    count = max(int(np.linalg.norm(b - a) / length), 1)
    append = vtk.vtkAppendPolyData()
    for i in range(0, count, 2):
        append.AddInputData(segment(a + (b - a) * i / count, a + (b - a) * (i + 1) / count))
    append.Update()
    return append.GetOutput()


def ball(centre, radius):
    source = vtk.vtkSphereSource()
    source.SetCenter(*centre)
    source.SetRadius(radius)
    source.SetThetaResolution(32)
    source.SetPhiResolution(32)
    source.Update()
    return source.GetOutput()


def flat_polygon(corners, height):
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    for x, y in corners:
        points.InsertNextPoint(x, y, height)
    cells = vtk.vtkCellArray()
    cells.InsertNextCell(len(corners), list(range(len(corners))))
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def polygon_outline(corners, height):
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    for x, y in corners:
        points.InsertNextPoint(x, y, height)
    cells = vtk.vtkCellArray()
    cells.InsertNextCell(len(corners) + 1, list(range(len(corners))) + [0])
    data.SetPoints(points)
    data.SetLines(cells)
    return data


def text(content, x, y, size, color=INK, bold=False, centred=False):
    result = vtk.vtkTextActor()
    result.SetInput(content)
    style = result.GetTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(size)
    style.SetColor(color)
    style.SetBold(bold)
    if centred:
        style.SetJustificationToCentered()
    style.SetVerticalJustificationToCentered()
    result.SetPosition(x, y)
    return result


def swatch(x, y, width, height, color):
    points = vtk.vtkPoints()
    for corner in ((x, y), (x + width, y), (x + width, y + height), (x, y + height)):
        points.InsertNextPoint(*corner, 0)
    cells = vtk.vtkCellArray()
    cells.InsertNextCell(4, [0, 1, 2, 3])
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    mapper = vtk.vtkPolyDataMapper2D()
    mapper.SetInputData(data)
    result = vtk.vtkActor2D()
    result.SetMapper(mapper)
    result.GetProperty().SetColor(color)
    return result


# ---------------------------------------------------------------- what the labels say


def angle(value):
    return f"{value:+.1f}\N{DEGREE SIGN}"


def labels(report, state):
    """Headline and details of one panel; `state` is "before" or "after"."""
    def get(key):
        value = report.get(f"{key}_{state}")
        return value if isinstance(value, float) else None

    headline, details = "", []
    goal = str(report.get("goal", ""))
    if goal in ("Spin", "Yo-yo"):
        offset, tilt = get("axis_offset"), get("axis_tilt")
        if offset is not None and tilt is not None:
            headline = f"wobbles: {offset:.2g} mm off the axis, tilted {tilt:.2g}\N{DEGREE SIGN}"
            if max(offset, tilt) < 0.01:
                headline = "balanced: mass on the axis, axis upright"
        ratios = get("moment_ratio_a"), get("moment_ratio_b")
        if None not in ratios:
            details.append(f"moments of inertia Izz/Ia = {ratios[0]:.2f}, Izz/Ib = {ratios[1]:.2f}")
        middle = get("middle_offset")
        if middle is not None:
            details[-1] += f", {abs(middle):.1f} mm off the middle"
    elif goal == "Stand empty and filled":
        empty, filled = get("tip_angle_empty"), get("tip_angle_filled")
        if None not in (empty, filled):
            stands = "stands" if min(empty, filled) > 0 else "topples"
            headline = f"{stands}: tipping angle {angle(empty)} empty, {angle(filled)} filled"
    elif goal == "Roll upright":
        faces = get("resting_faces")
        if faces is not None:
            upright = report.get(f"rolls_upright_{state}") is True
            headline = "comes back upright" if upright else "does not come back upright"
            details.append(f"stable resting faces: {faces:.0f}")
    elif goal == "Float":
        draught, heel, height = get("draught"), get("heel_angle"), get("metacentric_height")
        if draught is not None:
            headline = (f"floats, heel {heel:.1f}\N{DEGREE SIGN}"
                        if report.get(f"floats_{state}") is True else "sinks")
            if headline != "sinks":
                details.append(f"draught {draught:.3g} mm, metacentric height {height:.2g} mm")
    elif goal == "Hang":
        tilt = get("hanging_angle")
        if tilt is not None:
            headline = f"hangs {tilt:.1f}\N{DEGREE SIGN} off upright"
    elif goal == "Mass":
        error = get("mass_error")
        if error is not None:
            right = report.get(f"weighs_target_{state}") is True
            headline = "weighs as wished" if right else f"{abs(error):.3g} g too " + (
                "heavy" if error > 0 else "light")
    else:
        tip = get("tip_angle")
        if tip is not None:
            verdict = "stands" if tip > 0 else "topples"
            headline = f"{verdict}: tipping angle {angle(tip)}"
    mass = get("mass")
    last = [f"mass {mass:.3g} g"] if mass is not None else []
    wall = report.get("min_wall")
    if state == "after" and isinstance(wall, float) and wall > 0:
        last.append(f"least wall {wall:.3g} mm")
    details.append(", ".join(last))
    return headline, [line for line in details if line]


# ---------------------------------------------------------------- the picture


class Scene:
    """What both panels share: the frame, the cut and the camera."""

    def __init__(self, outer, before, after):
        self.diagonal = float(np.linalg.norm(np.ptp(outer[0], axis=0)))
        self.ground = float(outer[0][:, 2].min())
        self.height = float(np.ptp(outer[0][:, 2]))
        self.contact, self.contact_faces = contact_patches(outer, self.diagonal)
        self.pivot = polygon_centre(self.contact)
        along = cut_direction(outer, before, self.pivot, self.diagonal)
        self.along = np.array([*along, 0.0])
        self.towards = np.array([along[1], -along[0], 0.0])
        self.plane = vtk.vtkPlane()
        self.plane.SetOrigin(*after)
        self.plane.SetNormal(*self.towards)
        low, high = outer[0].min(axis=0), outer[0].max(axis=0)
        self.centre = (low + high) / 2
        self.points = outer[0]
        # The ground: a disc under the whole model.
        around = np.radians(np.arange(0, 360, 3))
        radius = np.linalg.norm(outer[0][:, :2] - self.centre[:2], axis=1).max()
        self.disc = self.centre[:2] + radius * np.c_[np.cos(around), np.sin(around)]

    def camera(self, aspect):
        sideways, elevation = np.radians(16), np.radians(14)
        view = (np.cos(elevation) * (np.cos(sideways) * self.towards + np.sin(sideways) * self.along)
                + np.array([0, 0, np.sin(elevation)]))
        right = np.cross([0, 0, 1], view)
        right /= np.linalg.norm(right)
        up = np.cross(view, right)
        rim = np.c_[self.disc, np.full(len(self.disc), self.ground)]
        shown = np.r_[self.points, rim]
        across, vertical = shown @ right, shown @ up
        focus = (right * (across.min() + across.max()) / 2 + up * (vertical.min() + vertical.max()) / 2
                 + view * (self.points @ view).mean())
        camera = vtk.vtkCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(*focus)
        camera.SetPosition(*(focus + 4 * self.diagonal * view))
        camera.SetViewUp(0, 0, 1)
        camera.SetParallelScale(0.52 * max(np.ptp(vertical), np.ptp(across) / aspect))
        camera.SetClippingRange(0.1 * self.diagonal, 9 * self.diagonal)
        return camera


def add_panel(window, size, scene, viewport, body, marks):
    """One half of the picture: the cut body in the lower layer, the marks on top of everything."""
    aspect = (viewport[2] - viewport[0]) * size[0] / ((viewport[3] - viewport[1]) * size[1])
    camera = scene.camera(aspect)
    lower, upper = vtk.vtkRenderer(), vtk.vtkRenderer()
    for layer, renderer in enumerate((lower, upper), start=1):
        renderer.SetViewport(*viewport)
        renderer.SetActiveCamera(camera)
        renderer.SetLayer(layer)
        window.AddRenderer(renderer)
    kit = vtk.vtkLightKit()
    kit.SetKeyLightIntensity(0.9)
    kit.SetKeyToFillRatio(2.2)
    kit.AddLightsToRenderer(lower)
    for item in body:
        lower.AddActor(item)
    for item in marks:
        upper.AddActor(item)
    # The renderer would shrink the clipping range to the actors of one layer.
    camera.SetClippingRange(0.1 * scene.diagonal, 9 * scene.diagonal)


def body_actors(scene, outer, inner):
    # Normals come last: clipping makes one point of those on both sides of a crease.
    result = [actor(with_normals(clipped(poly_data(*outer), scene.plane)), OUTER, 0.12, 0.85, 0.15)]
    meshes = [outer]
    if inner is not None:
        # The cavity is seen from within whatever way its triangles are turned.
        result.append(actor(with_normals(clipped(poly_data(*inner), scene.plane)), CAVITY, 0.15, 0.85))
        vertices, faces = inner
        meshes.append((vertices, faces[:, ::-1]) if signed_volume(inner) > 0 else inner)
    cap = section(meshes, scene.plane)
    result.append(actor(cap, MATERIAL, lit=False))
    for mesh in meshes:
        result.append(line_actor(outline(poly_data(*mesh), scene.plane), INK, 2))
    result.append(ground_actor(scene))
    return result


def ground_actor(scene):
    return actor(flat_polygon(scene.disc, scene.ground - 2e-3 * scene.diagonal), GROUND, lit=False)


def contact_actors(scene):
    height = scene.ground + 1e-3 * scene.diagonal
    result = []
    if len(scene.contact_faces):
        patch = actor(poly_data(scene.points, scene.contact_faces), CONTACT, lit=False)
        patch.GetProperty().SetOpacity(0.35)
        result.append(patch)
    if len(scene.contact) > 2:
        result.append(line_actor(polygon_outline(scene.contact, height), CONTACT, 4))
    return result


def mass_actors(scene, centre, color):
    foot = np.array([centre[0], centre[1], scene.ground])
    return [
        actor(ball(centre, 0.016 * scene.diagonal), color, 0.45, 0.6),
        line_actor(segment(centre, foot), color, 4),
        actor(ball(foot, 0.008 * scene.diagonal), color, 0.45, 0.6),
    ]


def water_actors(scene, report, state):
    """The water's surface around a body that floats upright."""
    draught, heel = report.get(f"draught_{state}"), report.get(f"heel_angle_{state}")
    if report.get(f"floats_{state}") is not True or heel > 1.0:
        return []
    height = scene.ground + draught
    sheet = actor(flat_polygon(scene.disc, height), WATER, lit=False)
    sheet.GetProperty().SetOpacity(0.35)
    return [sheet, line_actor(polygon_outline(scene.disc, height), WATER, 3)]


def thread_actors(scene):
    """The plumb line through the topmost point."""
    top = scene.points[scene.points[:, 2].argmax()]
    foot = [top[0], top[1], scene.ground]
    above = top + [0, 0, 0.1 * scene.height]
    return [line_actor(segment(top, above), INK, 3),
            line_actor(dashes(top, foot, 0.018 * scene.height), INK, 2)]


def goal_actors(scene, report, state, centre, inertia, color):
    goal = report.get("goal")
    if goal in ("Spin", "Yo-yo"):
        return axis_actors(scene, centre, inertia, color)
    if goal == "Float":
        return water_actors(scene, report, state)
    if goal == "Hang":
        return thread_actors(scene)
    return []


def axis_actors(scene, centre, inertia, color):
    """The vertical through the pivot, dashed, and the principal axis nearest to it."""
    bottom = np.array([*scene.pivot, scene.ground])
    top = bottom + [0, 0, 1.08 * scene.height]
    result = [line_actor(dashes(bottom, top, 0.018 * scene.height), INK, 2)]
    if inertia is not None:
        axis = vertical_principal_axis(inertia)
        below = (scene.ground - centre[2]) / axis[2]
        above = (top[2] - centre[2]) / axis[2]
        result.append(line_actor(segment(centre + below * axis, centre + above * axis), color, 4))
    return result


def render(arguments):
    rotation = up_rotation(arguments.up)

    def placed(mesh):
        return None if mesh is None else (mesh[0] @ rotation.T, mesh[1])

    outer = placed(read_mesh(arguments.outer))
    if outer is None:
        raise SystemExit(f"{arguments.outer} is missing or has no faces")
    inner = placed(read_mesh(arguments.inner))
    moved = placed(read_mesh(arguments.moved_outer))
    report = read_report(arguments.report)

    def vector(key):
        value = report.get(key)
        return rotation @ value if isinstance(value, np.ndarray) and value.shape == (3,) else None

    def tensor(key):
        value = report.get(key)
        if isinstance(value, np.ndarray) and value.shape == (3, 3):
            return rotation @ value @ rotation.T
        return None

    before = vector("center_of_mass_before")
    before = volume_centroid(outer) if before is None else before
    after = vector("center_of_mass_after")
    hollow = after is not None
    scene = Scene(outer, before, after if hollow else before)

    if not arguments.inner and not arguments.report:
        window = new_window(OUTSIDE_SIZE)
        body = [actor(with_normals(poly_data(*outer)), OUTER, 0.12, 0.85, 0.15), ground_actor(scene)]
        marks = contact_actors(scene) + mass_actors(scene, before, BEFORE)
        add_panel(window, OUTSIDE_SIZE, scene, (0.0, 0.0, 1.0, 1.0), body, marks)
        save(window, arguments.output)
        return

    window = new_window(SIZE)
    marks = contact_actors(scene) + mass_actors(scene, before, BEFORE)
    marks += goal_actors(scene, report, "before", before, tensor("inertia_tensor_before"), BEFORE)
    add_panel(window, SIZE, scene, (0.0, 0.08, 0.5, 0.77), body_actors(scene, outer, None), marks)

    marks = contact_actors(scene)
    if hollow:
        marks += mass_actors(scene, after, AFTER)
        marks.append(actor(ball(before, 0.009 * scene.diagonal), BEFORE, 0.45, 0.6))
    if hollow:
        marks += goal_actors(scene, report, "after", after, tensor("inertia_tensor_after"), AFTER)
    body = body_actors(scene, outer if moved is None else moved, inner)
    if moved is not None:
        body.append(line_actor(outline(poly_data(*outer), scene.plane), BEFORE, 2))
    add_panel(window, SIZE, scene, (0.5, 0.08, 1.0, 0.77), body, marks)

    add_labels(window, arguments, report, inner is not None)
    save(window, arguments.output)


def new_window(size):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetNumberOfLayers(4)
    window.SetSize(*size)
    paper = vtk.vtkRenderer()
    paper.SetBackground(BACKGROUND)
    window.AddRenderer(paper)
    return window


def save(window, path):
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(grab.GetOutputPort())
    writer.SetCompressionLevel(9)
    writer.SetFileName(path)
    writer.Write()


def add_labels(window, arguments, report, has_cavity):
    page = vtk.vtkRenderer()
    page.SetLayer(3)
    page.InteractiveOff()
    window.AddRenderer(page)
    name = os.path.splitext(os.path.basename(arguments.outer))[0].replace("_", " ")
    goal = report.get("goal")
    title = f"{name}: {str(goal).lower()}" if goal else name
    width, height = SIZE
    page.AddActor(text(title, width / 2, height - 40, 40, bold=True, centred=True))
    states = (("before", "before: solid", BEFORE, 0.25),
              ("after", "after: hollowed" if has_cavity else "after: no cavity", AFTER, 0.75))
    for state, heading, color, place in states:
        headline, details = labels(report, state)
        good = state == "after" and report.get("solved") is True
        page.AddActor(text(heading, place * width, height - 98, 30, centred=True))
        page.AddActor(text(headline, place * width, height - 140, 32,
                           AFTER if good else BEFORE, bold=True, centred=True))
        for i, detail in enumerate(details):
            page.AddActor(text(detail, place * width, height - 180 - 32 * i, 24, centred=True))
    mark = "centre of mass, principal axis" if goal == "Spin" else "centre of mass"
    legend = [(OUTER, "outer surface"), (MATERIAL, "material, cut"), (CAVITY, "cavity"),
              (BEFORE, f"{mark} before"), (AFTER, "after"), (CONTACT, "contact area")]
    entries = [(color, text(label, 0, 43, 22)) for color, label in legend]
    box, widths = [0.0] * 4, []
    for _, entry in entries:
        entry.GetBoundingBox(page, box)
        widths.append(box[1] - box[0])
    gap = (width - 80 - sum(widths) - 36 * len(entries)) / (len(entries) - 1)
    x = 40
    for (color, entry), used in zip(entries, widths):
        page.AddActor(swatch(x, 30, 26, 26, color))
        entry.SetPosition(x + 36, 43)
        page.AddActor(entry)
        x += 36 + used + gap


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--outer", required=True, help="the model, PLY")
    parser.add_argument("--inner", help="the cavity's surface, PLY; may be missing or empty")
    parser.add_argument("--moved-outer", help="the moved outer surface, PLY")
    parser.add_argument("--report", help="lines `key = value`")
    parser.add_argument("--up", choices=UP_AXES, default="+Z", help="which way is up")
    parser.add_argument("--output", required=True, help="the picture, PNG")
    render(parser.parse_args())


if __name__ == "__main__":
    main()
