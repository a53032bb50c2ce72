"""The filter in MeshLab's window, used with the mouse."""
import subprocess
import unittest

import numpy as np

import window
from desktop import wait_for, write_png
from host import FILTER, SAMPLES, cube, read_ply, refined, report_in, write_ply
from window import PICTURES, parameters


class FilterTest(window.WindowTest):
    def dinosaur(self, refinements=0):
        """MeshLab looks along -z with y up: turned, the model shows its side."""
        vertices, faces = read_ply(SAMPLES / "toy_dinosaur.ply")
        for _ in range(refinements):
            vertices, faces = refined(vertices, faces)
        vertices = vertices[:, [0, 2, 1]] * [1, 1, -1]
        return vertices, write_ply(self.folder / "toy.dinosaur.ply", vertices, faces)

    def test_stand(self):
        # MeshLab moves its bar ten times a second at most: the model is so large that it takes some.
        vertices, file = self.dinosaur(refinements=3)
        diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
        self.open(file)
        dialog = self.open_filter()

        labels = [w for w in self.desktop.all(dialog, "label") if self.desktop.shown(w)]
        switches = self.desktop.all(dialog, "check box")
        shown = [w.name.removesuffix(" (abs and %)") for w in labels + switches]
        listed = parameters(diagonal)
        self.assertGreater(len(listed), 10)
        for name, label, _ in listed:
            self.assertIn(label, shown, f"the label of {name}")
        wall = next(w for w in labels if w.name.startswith("Minimum wall"))
        self.assertAlmostEqual(
            float(self.desktop.text(self.field_beside(dialog, wall, "spin button"))),
            0.01 * diagonal, delta=1e-3)
        self.choose(dialog, "Goal", "Spin")
        self.choose(dialog, "Goal", "Stand")
        self.choose(dialog, "Up axis", "+Y")
        write_png(PICTURES / "dialog.png", self.desktop.picture(self.desktop.box(dialog)))
        self.assertEqual(self.layers(), ["toy.dinosaur"])

        bar = self.desktop.box(self.desktop.find(self.window, "status bar"))
        self.desktop.click(self.desktop.find(dialog, "push button", "Apply"))
        bars = self.pictures_until_applied(bar)
        self.assertGreater(len(bars), 5, "different states of the progress bar")
        self.desktop.click(self.desktop.find(dialog, "push button", "Close"))

        report = report_in(self.log())
        self.assertEqual(report["goal"], "Stand")
        self.assertTrue(report["solved"])
        self.assertFalse(report["stands_before"])
        self.assertTrue(report["stands_after"])
        self.assertEqual(self.layers(), ["toy.dinosaur", "toy_dinosaur inner offset surface *"])

        def shape(picture):
            return np.abs(picture - background).max(axis=2) > 12

        # Its normals point into the cavity.
        self.desktop.click(self.desktop.find(self.window, "check box", "Double"))
        cavity = self.view("result.png")
        self.eye(1)
        background = self.view()
        self.eye(0)
        # The view is narrower now that the list of layers is wider.
        solid = self.view()
        self.assertGreater(shape(cavity).sum(), 1000, "pixels of the cavity")
        self.assertFalse((shape(cavity) & ~shape(solid)).any(), "the cavity is inside of the model")
        self.assertLess(shape(cavity).sum(), 0.98 * shape(solid).sum())

        self.eye(1)
        x, y, width, height = self.canvas()
        for _ in range(24):  # each moves the near plane by a tenth towards the model's middle
            self.desktop.mouse(x + width // 2, y + 20, "keydown", "ctrl", "click", 4,
                               "keyup", "ctrl")
        cut = self.view("cut.png")
        changed = np.abs(cut - solid).max(axis=2) > 12
        self.assertGreater((changed & shape(cavity)).sum(), 0.5 * shape(cavity).sum())

    def test_the_answer_is_shown(self):
        self.open(self.dinosaur()[1])
        dialog = self.open_filter()
        self.choose(dialog, "Up axis", "+Y")
        self.desktop.click(self.scroll_to(dialog, "Show the answer (more layers)"))
        self.desktop.click(self.desktop.find(dialog, "push button", "Apply"))
        self.wait_for_log("Applied filter " + FILTER)
        self.desktop.click(self.desktop.find(dialog, "push button", "Close"))
        self.assertEqual(self.layers(),
                         ["toy.dinosaur", "toy_dinosaur cut open",
                          "toy_dinosaur centre of mass and contact area",
                          "toy_dinosaur inner offset surface *"])
        picture = self.view("answer.png")
        red, green, blue = picture.transpose(2, 0, 1)
        # The cut faces the viewer; the balls stick half out of it.
        for what, seen, least in (
                ("the cut", (red > 1.5 * blue) & (red > 1.2 * green) & (green > 1.2 * blue), 2000),
                ("before", (red > 2 * green) & (red > 2 * blue), 100),
                ("after", (green > 1.5 * red) & (green > 1.5 * blue), 100),
                ("the contact area", (blue > 1.5 * green) & (blue > 3 * red), 50)):
            self.assertGreater(seen.sum(), least, what)

    def test_escape_ends_a_run(self):
        _, file = self.dinosaur(refinements=4)
        self.open(file)
        dialog = self.open_filter()
        self.desktop.click(self.desktop.find(dialog, "push button", "Apply"))
        subprocess.run(["xdotool", "key", "Escape"], check=True)
        box = wait_for(lambda: next((w for w in self.application if w is not None
                                     and w.name == "Filter Failure"), None), "the message")
        (message,) = self.desktop.all(box, "label")[-1:]
        self.assertIn("The run was ended", message.name)
        self.desktop.click(self.desktop.find(box, "push button"))
        self.wait_for_log("Filter failed")
        self.assertEqual(self.layers(), ["toy.dinosaur"])

    def refuse(self, vertices, faces, *sentences):
        self.open(write_ply(self.folder / "refused.ply", vertices, faces))
        dialog = self.open_filter()
        self.desktop.click(self.desktop.find(dialog, "push button", "Apply"))
        box = wait_for(lambda: next((w for w in self.application if w is not None
                                     and w.name == "Filter Failure"), None), "the message")
        (message,) = self.desktop.all(box, "label")[-1:]
        for sentence in sentences:
            self.assertIn(sentence, message.name)
        self.desktop.click(self.desktop.find(box, "push button"))
        self.wait_for_log("Filter failed")
        self.assertEqual(self.layers(), ["refused"])

    def test_a_hole_is_closed(self):
        vertices, faces = cube()
        self.open(write_ply(self.folder / "holed.ply", vertices, faces[:-1]))
        dialog = self.open_filter()
        self.desktop.click(self.desktop.find(dialog, "push button", "Apply"))
        self.wait_for_log("Applied filter " + FILTER)
        self.desktop.click(self.desktop.find(dialog, "push button", "Close"))
        self.assertEqual(self.layers(), ["holed", "holed outer offset surface",
                                         "holed inner offset surface *"])

    def test_a_vase(self):
        vertices, faces = cube()
        opened = faces[vertices[faces][:, :, 2].min(axis=1) < 9.9]  # without its top
        self.refuse(vertices, opened, "1 opening is too large to be a hole", "open_surface")

    def test_points_without_faces(self):
        vertices, _ = cube()
        self.refuse(vertices, np.zeros((0, 3), int), "has points but no faces", "Screened Poisson")


if __name__ == "__main__":
    unittest.main()
