"""The filter's dialog on the screen of a small laptop, where not all of its parameters have room."""
import unittest

import window
from desktop import wait_for, write_png
from host import SAMPLES, report_in
from window import PICTURES, parameters


class SmallScreenTest(window.WindowTest):
    SCREEN = (1366, 768)
    WINDOW = (1366, 768)

    def inside(self, box, frame=None):
        x, y, width, height = box
        left, top, right, bottom = frame or (0, 0, *self.SCREEN)
        return left <= x and top <= y and x + width <= right and y + height <= bottom

    def assert_buttons_in_reach(self, dialog):
        self.assertTrue(self.inside(self.desktop.box(dialog)), self.desktop.box(dialog))
        for button in ("Default", "Help", "Close", "Apply"):
            self.assertTrue(self.inside(self.desktop.box(
                self.desktop.find(dialog, "push button", button))), button)

    def area(self, dialog):
        """Left, top, right and bottom of the part of the dialog that scrolls."""
        bar = next(w for w in self.desktop.all(dialog, "scroll bar") if self.desktop.shown(w))
        right, top, _, height = self.desktop.box(bar)
        return self.desktop.box(dialog)[0], top, right, top + height

    def scroll_to(self, dialog, label):
        """Turns the mouse wheel above the fields until a parameter can be read."""
        left, top, right, bottom = self.area(dialog)
        widget = next(w for role in ("label", "check box")
                      for w in self.desktop.all(dialog, role)
                      if w.name.removesuffix(" (abs and %)") == label)

        def readable():
            e = widget.queryComponent().getExtents(self.desktop.atspi.DESKTOP_COORDS)
            if self.inside((e.x, e.y, e.width, e.height), (left, top, right, bottom)):
                return True
            # Over the fields, some of which would take the wheel for a new value.
            self.desktop.mouse(left + (right - left) * 2 // 3, (top + bottom) // 2, "click", 5)
            return False

        wait_for(readable, f"'{label}' to be scrolled into view", 20)

    def test_dialog(self):
        self.open(SAMPLES / "toy_dinosaur.ply")
        dialog = self.open_filter()
        self.assert_buttons_in_reach(dialog)
        write_png(PICTURES / "small_screen.png", self.desktop.picture())
        for _, label, _ in parameters(1.0):
            self.scroll_to(dialog, label)
        write_png(PICTURES / "small_screen_scrolled.png", self.desktop.picture())
        self.desktop.click(self.desktop.find(dialog, "push button", "Help"))
        self.assert_buttons_in_reach(dialog)
        write_png(PICTURES / "small_screen_help.png", self.desktop.picture())

        self.desktop.click(self.desktop.find(dialog, "push button", "Apply"))
        self.pictures_until_applied(self.desktop.box(self.desktop.find(self.window, "status bar")))
        report = report_in(self.log())
        self.assertEqual(report["goal"], "Stand", "the wheel changes no value")
        self.assertTrue(report["solved"])


if __name__ == "__main__":
    unittest.main()
