#!/usr/bin/python3
"""Pictures of what build/release/benchmarks/thesis_experiments wrote into a folder: samples rebuilt
from k harmonics (rebuilt.png), cut open with their cavities of k harmonics (cavities.png), and their
skeletons with correspondences (skeletons.png).

Needs VTK 9 (Debian: python3-vtk9) and a display; without one run it under `xvfb-run -a`.
"""
import argparse
import pathlib

import vtk

import render

REBUILT = ("toy_dinosaur", "toy_dog")
REBUILT_SIZES = (4, 9, 16, 36, 100)
CAVITIES = ("box_on_corner", "tilted_ellipsoid_top", "toy_dinosaur", "leaning_ring")
CAVITY_SIZES = (4, 9, 16, 36, 64)
SKELETONS = ("toy_dinosaur", "toy_dog", "leaning_ring")

HEADING = 60  # height of the line above the panels
CAPTION = 62  # of the lines below each, if any


def mesh_of(folder, name):
    mesh = render.read_mesh(folder / f"{name}.ply")
    if mesh is None:
        raise SystemExit(f"{folder / name}.ply is missing: run thesis_experiments with this folder")
    return mesh


def scene_of(outer, before=None, after=None):
    """The view of the pictures of the demo, filled by the model."""
    before = render.volume_centroid(outer) if before is None else before
    scene = render.Scene(outer, before, before if after is None else after)
    scene.disc = scene.contact
    return scene


class Page:
    """Rows of panels with headings above the columns and captions below each panel."""

    def __init__(self, width, columns, heights, caption=CAPTION):
        self.columns, self.heights, self.caption = columns, heights, caption
        self.size = (width, HEADING + sum(h + caption for h in heights))
        self.window = render.new_window(self.size)
        self.texts = []

    def box(self, row, column):
        """Left, bottom, right and top in pixels."""
        top = self.size[1] - HEADING - sum(h + self.caption for h in self.heights[:row])
        width = self.size[0] / self.columns
        return column * width, top - self.heights[row], (column + 1) * width, top

    def head(self, column, text):
        left, _, right, _ = self.box(0, column)
        self.texts.append(render.text(text, (left + right) / 2, self.size[1] - HEADING / 2, 30,
                                      bold=True, centred=True))

    def panel(self, row, column, scene, actors, captions):
        box = self.box(row, column)
        viewport = [side / self.size[i % 2] for i, side in enumerate(box)]
        render.add_panel(self.window, self.size, scene, viewport, actors, [])
        for i, (caption, color) in enumerate(captions):
            self.texts.append(render.text(caption, (box[0] + box[2]) / 2, box[1] - 14 - 26 * i, 22,
                                          color, centred=True))

    def save(self, path):
        page = vtk.vtkRenderer()
        page.SetLayer(3)
        page.InteractiveOff()
        self.window.AddRenderer(page)
        for text in self.texts:
            page.AddActor(text)
        render.save(self.window, str(path))


def verdict_of(report):
    if "tip_angle_after" in report:
        return f"tipping angle {report['tip_angle_after']:.1f}\N{DEGREE SIGN}"
    return f"axis tilted by {report['axis_tilt_after']:.2f}\N{DEGREE SIGN}"


def solid_actor(mesh):
    return render.actor(render.with_normals(render.poly_data(*mesh)), render.OUTER, 0.12, 0.85, 0.15)


def draw_rebuilt(folder, output):
    page = Page(1600, len(REBUILT_SIZES) + 1, [250, 200])
    for column, size in enumerate(REBUILT_SIZES):
        page.head(column, f"k = {size}")
    page.head(len(REBUILT_SIZES), "sample")
    for row, name in enumerate(REBUILT):
        sample = mesh_of(folder, name)
        scene = scene_of(sample)
        errors = render.read_report(folder / f"{name}_rebuilt_report.txt")
        for column, size in enumerate(REBUILT_SIZES):
            caption = f"{100 * errors[f'rms_{size}']:.2g} % off"
            page.panel(row, column, scene, [solid_actor(mesh_of(folder, f"{name}_rebuilt_{size}"))],
                       [(caption, render.INK)])
        page.panel(row, len(REBUILT_SIZES), scene, [solid_actor(sample)],
                   [(f"{len(sample[0])} vertices", render.INK)])
    page.save(output)


def draw_cavities(folder, output):
    page = Page(1600, len(CAVITY_SIZES), [250, 250, 260, 330])
    for column, size in enumerate(CAVITY_SIZES):
        page.head(column, f"k = {size}")
    for row, name in enumerate(CAVITIES):
        sample = mesh_of(folder, name)
        # One plane for the whole row.
        usual = render.read_report(folder / f"{name}_k36_report.txt")
        scene = scene_of(sample, usual["center_of_mass_before"], usual["center_of_mass_after"])
        for column, size in enumerate(CAVITY_SIZES):
            report = render.read_report(folder / f"{name}_k{size}_report.txt")
            cavity = render.read_mesh(folder / f"{name}_k{size}.ply")
            color = render.AFTER if report["solved"] else render.BEFORE
            page.panel(row, column, scene, render.body_actors(scene, sample, cavity)[:-1],
                       [(f"f = {report['objective_after']:.4f}", render.INK), (verdict_of(report), color)])
    page.save(output)


def coloured_actor(path):
    """In the colours of the vertices."""
    reader = vtk.vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(reader.GetOutput())
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    result.GetProperty().SetAmbient(0.4)
    result.GetProperty().SetDiffuse(0.6)
    return result


def silhouette_actor(mesh, scene, aspect):
    """The outline of the model as the camera sees it."""
    silhouette = vtk.vtkPolyDataSilhouette()
    silhouette.SetInputData(render.poly_data(*mesh))
    silhouette.SetCamera(scene.camera(aspect))
    silhouette.SetEnableFeatureAngle(0)
    silhouette.Update()
    return render.line_actor(silhouette.GetOutput(), render.INK, 2)


def draw_skeletons(folder, output):
    page = Page(1200, len(SKELETONS), [370], caption=0)
    for column, name in enumerate(SKELETONS):
        sample = mesh_of(folder, name)
        scene = scene_of(sample)
        left, bottom, right, top = page.box(0, column)
        marks = coloured_actor(folder / f"{name}_skeleton.ply")
        glass = solid_actor(sample)
        glass.GetProperty().SetOpacity(0.12)
        outline = silhouette_actor(sample, scene, (right - left) / (top - bottom))
        page.head(column, name.replace("_", " "))
        page.panel(0, column, scene, [marks, glass, outline], [])
    page.save(output)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", type=pathlib.Path, help="what thesis_experiments wrote")
    parser.add_argument("output", type=pathlib.Path, help="where the pictures go")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    draw_rebuilt(arguments.folder, arguments.output / "rebuilt.png")
    draw_cavities(arguments.folder, arguments.output / "cavities.png")
    draw_skeletons(arguments.folder, arguments.output / "skeletons.png")


if __name__ == "__main__":
    main()
