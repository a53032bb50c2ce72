"""The filter's dialog on the screen of a small laptop, where not all of its parameters have room."""
import unittest

import window
from desktop import write_png
from host import SAMPLES, report_in
from window import PICTURES, parameters


class SmallScreenTest(window.WindowTest):
    SCREEN = (1366, 768)
    WINDOW = (1366, 768)

    def on_screen(self, box):
        return self.inside(box, (0, 0, *self.SCREEN))

    def assert_buttons_in_reach(self, dialog):
        self.assertTrue(self.on_screen(self.desktop.box(dialog)), self.desktop.box(dialog))
        for button in ("Default", "Help", "Close", "Apply"):
            self.assertTrue(self.on_screen(self.desktop.box(
                self.desktop.find(dialog, "push button", button))), button)

    def test_dialog(self):
        self.open(SAMPLES / "toy_dinosaur.ply")
        dialog = self.open_filter()
        self.assert_buttons_in_reach(dialog)
        write_png(PICTURES / "small_screen.png", self.desktop.picture())
        self.assertIsNotNone(self.scrolled_part(dialog), "not all has room")
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
