"""The slicer makes what the report says: every sample's project is sliced by PrusaSlicer, and the
extrusions are weighed."""
import os
import pathlib
import shutil
import sys
import unittest
import xml.etree.ElementTree as xml
import zipfile

import numpy as np

import gcode
from host import (BUILD_AXIS, IS_THOROUGH, SAMPLES, HostTest, changed_script, delivered_folder,
                  meshlabserver, report_in, script_of)

# Of the mass. The yo-yo has sheets thinner than two lines.
MASS = {"uneven_yo_yo": 0.04}
MASS_OF_OTHERS = 0.03
INFILL = 0.1
# Stand empty and filled.
WITHOUT_INFILL = {"leaning_jar"}
# A mass that can be reached without a heavy filling.
FOR_INFILL = {"game_piece": {"target_mass": 16}}
# Empty cavities that are to be printed without support.
CEILINGS = ["leaning_egg", "toy_dinosaur"]
# Those that differ in kind: printed in another pose than used, filled later, with a moved outer surface, on
# four legs; with a mass to reach, of thin sheets. All samples where there is time.
HOLLOW = ["hanging_fish", "leaning_jar", "leaning_skittle", "toy_dog"]
WITH_INFILL = ["game_piece", "uneven_yo_yo"]


def parts_of(project):
    """Vertices (on the plate) and triangles of each part by its role, from the project's files."""
    with zipfile.ZipFile(project) as archive:
        model = xml.fromstring(archive.read("3D/3dmodel.model"))
        config = xml.fromstring(archive.read("Metadata/Slic3r_PE_model.config"))
    space = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    points = np.array([[float(v.get(axis)) for axis in "xyz"] for v in model.iter(space + "vertex")])
    faces = np.array([[int(t.get(c)) for c in ("v1", "v2", "v3")]
                      for t in model.iter(space + "triangle")])
    matrix = np.array(model.find(f".//{space}item").get("transform").split(), float).reshape(4, 3)
    points = points @ matrix[:3] + matrix[3]
    parts = {}
    for volume in config.iter("volume"):
        role = volume.find("metadata[@key='volume_type']").get("value")
        parts[role] = points, faces[int(volume.get("firstid")):int(volume.get("lastid")) + 1]
    return parts


def is_inside(vertices, faces, points):
    """For each point whether a ray along x leaves the closed surface."""
    a, b, c = vertices[faces].transpose(1, 0, 2)
    result = []
    for p in points:
        # Triangles seen along x.
        def side(u, v):
            return (u[:, 1] - p[1]) * (v[:, 2] - p[2]) - (u[:, 2] - p[2]) * (v[:, 1] - p[1])
        weights = np.stack([side(b, c), side(c, a), side(a, b)], axis=1)
        hit = (weights > 0).all(1) | (weights < 0).all(1)
        w = weights[hit] / weights[hit].sum(1, keepdims=True)
        x = w[:, 0] * a[hit, 0] + w[:, 1] * b[hit, 0] + w[:, 2] * c[hit, 0]
        result.append((x > p[0]).sum() % 2 == 1)
    return np.array(result, bool)


class SlicerTest(HostTest):
    def print_of(self, sample, **values):
        """Report, project file and extrusions of a sample that is printed; as it is delivered, where
        nothing is asked for."""
        delivered = delivered_folder()
        if not values and delivered and (delivered / f"{sample}.3mf").exists():
            project = pathlib.Path(shutil.copy(delivered / f"{sample}.3mf", self.folder))
            log = (delivered / f"{sample}_report.txt").read_text()
            extrusions = gcode.slice_project(project, self.folder / f"{sample}.gcode")
            return report_in(log), project, extrusions
        project = self.folder / f"{sample}.3mf"
        script = changed_script(script_of(sample), self.folder / "print.mlx", print_file=project,
                                build_axis=BUILD_AXIS.get(sample, 0), **values)
        status, log = meshlabserver("-i", SAMPLES / f"{sample}.ply", "-o", self.folder / "inner.ply",
                                    "-l", "x", "-s", script)
        self.assertEqual(status, 0, log)
        extrusions = gcode.slice_project(project, self.folder / f"{sample}.gcode")
        return report_in(log), project, extrusions

    def check(self, sample, infill):
        # What is printed as infill cannot be filled in later.
        values = {}
        if infill > 0:
            values = {"cavity_infill": infill, "fill_density": 0, **FOR_INFILL.get(sample, {})}
        report, project, extrusions = self.print_of(sample, **values)
        script = xml.parse(script_of(sample))
        density, filling = (float(script.find(f".//Param[@name='{name}']").get("value"))
                            for name in ("density", "fill_density"))
        body = extrusions.of_the_body()
        mass, centre = body.mass(density), body.centre()
        off = np.linalg.norm(centre - report["print_center_of_mass"])
        parts = parts_of(project)
        size = np.linalg.norm(np.ptp(parts["ModelPart"][0], axis=0))
        print(f"{sample:22} infill {infill:4} mass {report['print_mass']:7.2f} g {mass:7.2f} g "
              f"{100 * (mass / report['print_mass'] - 1):+5.2f} %  centre {off:.2f} of "
              f"{max(0.3, 0.005 * size):.2f} mm", flush=True)
        self.assertAlmostEqual(mass / report["print_mass"], 1.0,
                               delta=MASS.get(sample, MASS_OF_OTHERS))
        self.assertLess(off, max(0.3, 0.005 * size))

        # What is printed has the report's mass, but for what is filled in later.
        if infill > 0 or filling == 0:
            self.assertAlmostEqual(report["print_mass"] / report["mass_after"], 1.0, delta=1e-6)
        self.check_support(parts, extrusions, infill)
        if "MASSPROPS_PRINTED" in os.environ:
            self.keep(sample, infill, project)

    def check_ceilings(self, sample):
        """What is printed above a cavity has something below it within half a bridge, and less of it
        hangs out by more than a line and a half than where the ceiling is as flat as it comes."""
        hanging = {}
        for angle in (0, 45):
            _, project, extrusions = self.print_of(sample, overhang_angle=angle,
                                                   cavity_shape=0 if angle else 2)
            parts = parts_of(project)
            vertices, faces = parts["SupportBlocker"]
            reach, area = gcode.reaches(extrusions, vertices[np.unique(faces)])
            hanging[angle] = area[reach > 0.7][0]
            self.check_support(parts, extrusions, 0)
            print(f"{sample:22} overhang_angle {angle:2}: {hanging[angle]:5.1f} mm² hang out by more than "
                  f"0.7 mm, the farthest by {reach[area > 0].max() + 0.25:.2f} mm", flush=True)
        self.assertLess(hanging[45], 0.5 * hanging[0])
        self.assertEqual(area[reach > gcode.HALF_BRIDGE].sum(), 0)

    def check_support(self, parts, extrusions, infill):
        """Outside only: nobody could take it out of a cavity."""
        support = extrusions.support()
        if infill > 0:
            cavity = parts["ParameterModifier"]
        else:
            cavity = parts["SupportBlocker"]
            cavity = cavity[0] - [0, 0, gcode.LAYER], cavity[1]
        middles = support.middles()
        chosen = np.linspace(0, len(middles) - 1, min(len(middles), 400)).astype(int)
        self.assertEqual(is_inside(*cavity, middles[chosen]).sum(), 0)

    def keep(self, sample, infill, project):
        folder = os.environ["MASSPROPS_PRINTED"]
        name = f"{sample}_{infill:g}"
        os.makedirs(folder, exist_ok=True)
        for source in (project, project.with_suffix(".gcode")):
            source.rename(os.path.join(folder, name + source.suffix))


def add_tests():
    for mesh in sorted(SAMPLES.glob("*.ply")):
        sample = mesh.stem
        if IS_THOROUGH or sample in HOLLOW:
            setattr(SlicerTest, f"test_{sample}_hollow", lambda self, s=sample: self.check(s, 0))
        if sample not in WITHOUT_INFILL and (IS_THOROUGH or sample in WITH_INFILL):
            setattr(SlicerTest, f"test_{sample}_infill", lambda self, s=sample: self.check(s, INFILL))
    for sample in CEILINGS if IS_THOROUGH else CEILINGS[:1]:
        setattr(SlicerTest, f"test_{sample}_ceilings", lambda self, s=sample: self.check_ceilings(s))


add_tests()

if __name__ == "__main__":
    sys.exit(unittest.main())
