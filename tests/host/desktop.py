"""A virtual screen on which MeshLab's window is used as by hand: widgets are found by the
accessibility interface (AT-SPI), clicks are those of a mouse, pictures are what the screen shows."""
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

import numpy as np


def wait_for(condition, what, seconds=60):
    """The first value of `condition()` that is true; asked again and again, as widgets come late."""
    end = time.monotonic() + seconds
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError(f"waited {seconds} s in vain for {what}")
        time.sleep(0.1)


def write_png(path, picture):
    """`picture`: height × width × 3 bytes."""
    height, width, _ = picture.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), picture.reshape(height, -1)], axis=1)

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))

    pathlib.Path(path).write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))


class Desktop:
    """A screen, a session bus and a home folder of its own; `close` ends them."""

    def __init__(self, width=1400, height=1100):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="massprops-desktop-"))
        self.processes = []
        (self.folder / "home").mkdir()
        (self.folder / "runtime").mkdir(mode=0o700)
        read, write = os.pipe()
        self.start(["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24",
                    "-nolisten", "tcp", "-noreset", "-fbdir", self.folder], pass_fds=[write])
        os.close(write)
        with os.fdopen(read) as display:
            number = display.readline().strip()
        if not number:
            raise RuntimeError("Xvfb does not start")
        os.environ.update(DISPLAY=":" + number, HOME=str(self.folder / "home"),
                          XDG_RUNTIME_DIR=str(self.folder / "runtime"), LC_ALL="C.UTF-8",
                          QT_LINUX_ACCESSIBILITY_ALWAYS_ON="1", NO_AT_BRIDGE="0")
        os.environ.pop("XAUTHORITY", None)
        bus = self.start(["dbus-daemon", "--session", "--nofork", "--print-address"],
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        os.environ["DBUS_SESSION_BUS_ADDRESS"] = bus.stdout.readline().decode().strip()
        # Programs that start before the registry of widgets answers are never listed in it.
        wait_for(self.registry_answers, "the registry of widgets")
        import pyatspi
        self.atspi = pyatspi

    @staticmethod
    def registry_answers():
        def ask(*arguments):
            done = subprocess.run(["dbus-send", "--print-reply=literal", *arguments], check=False,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            return done.stdout.decode().strip() if done.returncode == 0 else None

        bus = ask("--session", "--dest=org.a11y.Bus", "/org/a11y/bus", "org.a11y.Bus.GetAddress")
        return bus and ask("--bus=" + bus, "--dest=org.a11y.atspi.Registry",
                           "/org/a11y/atspi/accessible/root",
                           "org.a11y.atspi.Accessible.GetChildren") is not None

    def start(self, command, **options):
        process = subprocess.Popen(list(map(str, command)), **options)
        self.processes.append(process)
        return process

    def close(self):
        for process in reversed(self.processes):
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            if process.stdout:
                process.stdout.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def picture(self, box=None):
        """What the screen shows in `box` = (x, y, width, height), or all of it."""
        data = (self.folder / "Xvfb_screen0").read_bytes()
        header = struct.unpack(">25I", data[:100])  # an X window dump
        size, width, height, stride, colors = header[0], header[4], header[5], header[12], header[19]
        pixels = np.frombuffer(data, np.uint8, stride * height, size + 12 * colors)
        picture = pixels.reshape(height, -1, 4)[:, :width, 2::-1]
        if box:
            x, y, w, h = box
            picture = picture[max(y, 0):y + h, max(x, 0):x + w]
        return np.ascontiguousarray(picture)

    def still_picture(self, box, seconds=20):
        """The picture once it has stopped changing."""
        last = []

        def still():
            last.append(self.picture(box))
            time.sleep(0.3)
            return len(last) > 2 and all((last[-1] == other).all() for other in last[-3:-1])

        wait_for(still, "the picture to stand still", seconds)
        return last[-1]

    def mouse(self, x, y, *action):
        subprocess.run(["xdotool", "mousemove", str(x), str(y), *map(str, action)], check=True)

    def click(self, widget):
        x, y, width, height = self.box(widget)
        self.mouse(x + width // 2, y + height // 2, "click", 1)

    def box(self, widget):
        """Place of a widget on the screen, once it is shown and no longer moves."""
        last = []

        def settled():
            e = widget.queryComponent().getExtents(self.atspi.DESKTOP_COORDS)
            last.append((e.x, e.y, e.width, e.height))
            return self.shown(widget) and e.width > 0 and len(last) > 1 and last[-1] == last[-2]

        wait_for(settled, f"'{widget.name}' to be shown")
        return last[-1]

    def shown(self, widget):
        return widget.getState().contains(self.atspi.STATE_SHOWING)

    def applications(self):
        return [one for one in self.atspi.Registry.getDesktop(0) if one is not None]

    def all(self, root, role, name=None):
        """Every widget below `root` of that role and name that is there just now."""
        found = []
        try:
            for child in root:
                if child is None:
                    continue
                if child.getRoleName() == role and name in (None, child.name):
                    found.append(child)
                found += self.all(child, role, name)
        except Exception as error:  # pylint: disable=broad-except
            # Widgets vanish while they are looked at; the caller asks again.
            if "atspi" not in str(type(error)).lower() and "gi." not in str(type(error)).lower() \
                    and "GLib" not in str(type(error)):
                raise
        return found

    def find(self, root, role, name=None, seconds=60):
        """The first such widget that is shown, waiting for it."""
        return wait_for(lambda: next((w for w in self.all(root, role, name) if self.shown(w)), None),
                        f"the {role} '{name}'", seconds)

    def text(self, widget):
        """The text in a widget; Qt ends its lines with line separators."""
        return widget.queryText().getText(0, -1).replace("\u2028", "\n")
