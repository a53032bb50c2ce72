#!/usr/bin/python3
"""Draws the ends of two cavities of one model side by side, the model as glass around them: with its
ends as the offsets leave them, and with smooth caps.

usage: scripts/caps_pictures.py <model.ply> <before.ply> <after.ply> <picture.png>
           <seen from: x,y,z> <middle: x,y,z> <height>
The direction points from the middle to the eye; the middle is in the model's coordinates, the
height of what is shown in its unit.

Needs VTK 9 (Debian: python3-vtk9) and a display; without one run it under `xvfb-run -a`.
"""
import sys

import numpy as np
import vtk

import render

SIZE = (900, 450)


def panel(window, model, cavity, viewport, seen_from, middle, height):
    scene = vtk.vtkRenderer()
    scene.SetLayer(1)
    scene.SetViewport(*viewport)
    glass = render.actor(render.with_normals(render.poly_data(*model)), render.OUTER, 0.1, 0.9)
    glass.GetProperty().SetOpacity(0.15)
    scene.AddActor(render.actor(render.with_normals(render.poly_data(*cavity)), render.CAVITY, 0.1,
                                0.9, 0.1))
    scene.AddActor(glass)
    scene.SetUseDepthPeeling(True)
    camera = scene.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*middle)
    far = 2 * np.linalg.norm(np.ptp(model[0], axis=0))
    camera.SetPosition(*(middle + far * seen_from / np.linalg.norm(seen_from)))
    camera.SetViewUp(0, 0, 1)
    camera.SetParallelScale(height / 2)
    scene.ResetCameraClippingRange()
    window.AddRenderer(scene)


def main(model, before, after, picture, seen_from, middle, height):
    numbers = [np.array(text.split(","), float) for text in (seen_from, middle)]
    window = render.new_window(SIZE)
    window.SetAlphaBitPlanes(True)
    window.SetMultiSamples(0)
    for name, viewport in ((before, (0, 0, 0.5, 1)), (after, (0.5, 0, 1, 1))):
        panel(window, render.read_mesh(model), render.read_mesh(name), viewport, *numbers,
              float(height))
    render.save(window, picture)


if __name__ == "__main__":
    if len(sys.argv) != 8:
        sys.exit(__doc__)
    main(*sys.argv[1:])
