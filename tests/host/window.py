"""MeshLab's window, used with the mouse. Pictures of it are left in the folder MASSPROPS_PICTURES."""
import os
import pathlib
import subprocess
import threading

from desktop import Desktop, wait_for, write_png
from host import FILTER, ROOT, HostTest, host_folder

PICTURES = pathlib.Path(os.environ.get("MASSPROPS_PICTURES", ROOT / "build" / "window"))
CATEGORY = "Remeshing, Simplification and Reconstruction"


def parameters(diagonal):
    """Name, label and tooltip of every parameter, from the plugin's own list."""
    done = subprocess.run([os.environ["MASSPROPS_LIST_PARAMETERS"], str(diagonal)], check=True,
                          stdout=subprocess.PIPE)
    return [line.split("\t") for line in done.stdout.decode().splitlines()]


class WindowTest(HostTest):
    """MeshLab on a screen of its own."""

    SCREEN = (1400, 1700)
    WINDOW = (1300, 950)

    @classmethod
    def setUpClass(cls):
        PICTURES.mkdir(parents=True, exist_ok=True)
        cls.desktop = Desktop(*cls.SCREEN)
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
                        identity, *map(str, self.WINDOW)], check=True)
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

    @staticmethod
    def inside(box, frame):
        x, y, width, height = box
        left, top, right, bottom = frame
        return left <= x and top <= y and x + width <= right and y + height <= bottom

    def scrolled_part(self, dialog):
        """Left, top, right and bottom of the part of the dialog that scrolls; None where all has room."""
        bar = next((w for w in self.desktop.all(dialog, "scroll bar") if self.desktop.shown(w)), None)
        if bar is None:
            return None
        right, top, _, height = self.desktop.box(bar)
        return self.desktop.box(dialog)[0], top, right, top + height

    def scroll_to(self, dialog, label):
        """Turns the mouse wheel above the fields until a parameter can be read; returns its label or
        check box."""
        widget = next(w for role in ("label", "check box")
                      for w in self.desktop.all(dialog, role)
                      if w.name.removesuffix(" (abs and %)") == label)
        frame = self.scrolled_part(dialog)
        if frame is None:
            return widget
        left, top, right, bottom = frame

        def readable():
            e = widget.queryComponent().getExtents(self.desktop.atspi.DESKTOP_COORDS)
            if self.inside((e.x, e.y, e.width, e.height), frame):
                return True
            # Over the fields, some of which would take the wheel for a new value.
            self.desktop.mouse(left + (right - left) * 2 // 3, (top + bottom) // 2, "click",
                               4 if e.y < top else 5)
            return False

        wait_for(readable, f"'{label}' to be scrolled into view", 20)
        return widget

    def choose(self, dialog, label, entry):
        self.scroll_to(dialog, label)
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
        panes = wait_for(lambda: self.desktop.all(self.window, "split pane"), "the 3D view")
        x, y, width, height = self.desktop.box(panes[0])
        return x + 8, y + 8, width - 16, height - 16

    def eye(self, row):
        """Shows or hides a layer by a click on its eye."""
        tree = self.desktop.all(self.window, "tree")[0]
        self.desktop.click(self.desktop.all(tree, "table cell")[4 * row])

    def view(self, name=None):
        """What the 3D view shows once it stands still."""
        self.desktop.mouse(*(side - 10 for side in self.SCREEN))  # away from the window
        picture = self.desktop.still_picture(self.canvas())
        if name:
            write_png(PICTURES / name, picture)
        return picture.astype(int)

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
