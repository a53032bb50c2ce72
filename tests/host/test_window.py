"""The filter in MeshLab's window, used with the mouse. Pictures of it are left in the folder
MASSPROPS_PICTURES."""
import os
import pathlib
import subprocess
import threading
import unittest

import numpy as np

from desktop import Desktop, wait_for, write_png
from host import FILTER, ROOT, SAMPLES, HostTest, cube, host_folder, read_ply, report_in, write_ply

PICTURES = pathlib.Path(os.environ.get("MASSPROPS_PICTURES", ROOT / "build" / "window"))
CATEGORY = "Remeshing, Simplification and Reconstruction"


def parameters(diagonal):
    """Name, label and tooltip of every parameter, from the plugin's own list."""
    done = subprocess.run([os.environ["MASSPROPS_LIST_PARAMETERS"], str(diagonal)], check=True,
                          stdout=subprocess.PIPE)
    return [line.split("\t") for line in done.stdout.decode().splitlines()]


class WindowTest(HostTest):
    @classmethod
    def setUpClass(cls):
        PICTURES.mkdir(parents=True, exist_ok=True)
        cls.desktop = Desktop()
        cls.addClassCleanup(cls.desktop.close)

    def open(self, mesh):
        """Starts MeshLab with a model; ends it after the test."""
        folder, libraries = host_folder()
        log = open(self.folder / "meshlab.log", "wb")
        self.addCleanup(log.close)
        self.process = subprocess.Popen(
            [folder / "meshlab", mesh], stdout=log, stderr=log,
            env=dict(os.environ, LD_LIBRARY_PATH=str(libraries)))
        self.addCleanup(self.process.wait)
        self.addCleanup(self.process.kill)
        self.application = wait_for(
            lambda: next((a for a in self.desktop.applications()
                          if a.name.startswith("MeshLab") and a.get_process_id() == self.process.pid),
                         None), "MeshLab's window")
        self.window = wait_for(lambda: next((w for w in self.application if w is not None
                                             and w.getRoleName() == "frame"
                                             and w.name.startswith("MeshLab")), None),
                               "MeshLab's main window")
        self.wait_for_log("Opened mesh")
        identity = subprocess.run(["xdotool", "search", "--onlyvisible", "--pid",
                                   str(self.process.pid), "--name", "^MeshLab 20"], check=True,
                                  stdout=subprocess.PIPE).stdout.split()[0].decode()
        subprocess.run(["xdotool", "windowmove", identity, "0", "0", "windowsize", "--sync",
                        identity, "1300", "950"], check=True)
        # The panel tells the speed of drawing, which is never the same.
        self.menu("View", "Show Info Panel")

    def log(self):
        return "\n".join(self.desktop.text(w) for w in self.desktop.all(self.window, "text")
                         if self.desktop.shown(w))

    def wait_for_log(self, text, seconds=120):
        def present():
            self.assertIsNone(self.process.poll(), "MeshLab ended")
            return text in self.log()
        wait_for(present, f"'{text}' in the log", seconds)

    def menu(self, *names):
        above = self.desktop.find(self.window, "menu bar")
        for name in names:
            above = self.desktop.find(above, "menu item", name)
            self.desktop.click(above)

    def open_filter(self):
        self.menu("Filters", CATEGORY, FILTER)
        dialog = wait_for(lambda: next((w for w in self.application if w is not None
                                        and w.name == FILTER), None), "the filter's dialog")
        self.desktop.find(dialog, "push button", "Apply")
        return dialog

    def field_beside(self, dialog, label, role):
        """The widget of that role in the row of a label."""
        _, y, _, height = self.desktop.box(label)
        def beside():
            for widget in self.desktop.all(dialog, role):
                box = widget.queryComponent().getExtents(self.desktop.atspi.DESKTOP_COORDS)
                if box.y < y + height and y < box.y + box.height and self.desktop.shown(widget):
                    return widget
            return None
        return wait_for(beside, f"the {role} beside '{label.name}'")

    def choose(self, dialog, label, entry):
        box = self.field_beside(dialog, self.desktop.find(dialog, "label", label), "combo box")
        self.desktop.click(box)
        self.desktop.click(self.desktop.find(box, "list item", entry))
        wait_for(lambda: box.name == entry, f"'{entry}' to be chosen")

    def layers(self):
        """Names of the mesh layers, top to bottom."""
        tree = self.desktop.all(self.window, "tree")[0]
        cells = self.desktop.all(tree, "table cell")
        return [cells[i + 2].name for i in range(0, len(cells) - 3, 4)]

    def canvas(self):
        """Box of the 3D view."""
        x, y, width, height = self.desktop.box(self.desktop.all(self.window, "split pane")[0])
        return x + 8, y + 8, width - 16, height - 16

    def eye(self, row):
        """Shows or hides a layer by a click on its eye."""
        tree = self.desktop.all(self.window, "tree")[0]
        self.desktop.click(self.desktop.all(tree, "table cell")[4 * row])

    def view(self, name=None):
        """What the 3D view shows once it stands still."""
        self.desktop.mouse(1390, 1090)  # away from the window
        picture = self.desktop.still_picture(self.canvas())
        if name:
            write_png(PICTURES / name, picture)
        return picture.astype(int)

    def dinosaur(self):
        """MeshLab looks along -z with y up: turned, the model shows its side."""
        vertices, faces = read_ply(SAMPLES / "toy_dinosaur.ply")
        vertices = vertices[:, [0, 2, 1]] * [1, 1, -1]
        return vertices, write_ply(self.folder / "toy.dinosaur.ply", vertices, faces)

    def test_stand(self):
        vertices, file = self.dinosaur()
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
        self.desktop.click(self.desktop.find(dialog, "check box", "Show the answer (more layers)"))
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

    def pictures_until_applied(self, box):
        """The different pictures of a part of the screen until the filter has ended."""
        pictures = set()
        ended = threading.Event()

        # The window answers questions only between two steps of the progress.
        def look():
            while not ended.wait(0.02):
                pictures.add(self.desktop.picture(box).tobytes())

        looking = threading.Thread(target=look)
        looking.start()
        try:
            self.wait_for_log("Applied filter " + FILTER)
        finally:
            ended.set()
            looking.join()
        return pictures

    def test_failure(self):
        vertices, faces = cube()
        self.open(write_ply(self.folder / "open.ply", vertices, faces[:-1]))
        dialog = self.open_filter()
        self.desktop.click(self.desktop.find(dialog, "push button", "Apply"))
        box = wait_for(lambda: next((w for w in self.application if w is not None
                                     and w.name == "Filter Failure"), None), "the message")
        (message,) = self.desktop.all(box, "label")[-1:]
        self.assertIn("The surface is open along 3 boundary edges", message.name)
        self.assertIn("Close Holes", message.name)
        self.desktop.click(self.desktop.find(box, "push button"))
        self.wait_for_log("Filter failed")
        self.assertEqual(self.layers(), ["open"])


if __name__ == "__main__":
    unittest.main()
