"""What docs/meshlab.md and docs/hosts.md show of meshlabserver and PyMeshLab, as it stands there."""
import ast
import os
import re
import subprocess
import unittest

from host import (ROOT, SAMPLES, HostTest, bounds_a_volume, changed_script, host_folder, layers_of,
                  read_ply, report_in)

PAGES = ("docs/meshlab.md", "docs/hosts.md")
FILTER_CALLS = ("apply_filter", "mass_property_optimization")


def shown(pattern):
    """All that matches in the pages, in their order."""
    texts = ((ROOT / page).read_text(encoding="utf-8") for page in PAGES)
    return [match for text in texts for match in re.findall(pattern, text, re.MULTILINE | re.DOTALL)]


class MeshlabserverTest(HostTest):
    def run_line(self, line):
        """As if the plugin were installed; what the line prints."""
        programs, libraries = host_folder()
        done = subprocess.run(["sh", "-euc", line], cwd=self.folder, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, check=False,
                              env=dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}",
                                       LD_LIBRARY_PATH=str(libraries)))
        # 5: xvfb-run could not clean up.
        self.assertIn(done.returncode, (0, 5), line)
        return done.stdout.decode()

    def test_lines(self):
        (self.folder / "sample_meshes").symlink_to(SAMPLES)
        (self.folder / "stand.mlx").symlink_to(SAMPLES / "stand.mlx")
        (self.folder / "flatten.mlx").symlink_to(ROOT / "scripts" / "flatten.mlx")
        (self.folder / "model.ply").symlink_to(SAMPLES / "box_on_corner.ply")
        changed_script(SAMPLES / "stand.mlx", self.folder / "show.mlx", show_layers="true")
        lines = shown(r"^xvfb-run [^\n]*$")
        self.assertGreaterEqual(len(lines), 6)
        for line in lines:
            with self.subTest(line):
                written = re.findall(r"-[ow] (\S+)", line)
                for name in written:
                    (self.folder / name).unlink(missing_ok=True)
                said = self.run_line(line)
                self.assertTrue(all((self.folder / name).is_file() for name in written))
                hollows = "stand.mlx" in line or "show.mlx" in line
                self.assertEqual(report_in(said).get("solved", False), hollows)
        self.assertEqual(bounds_a_volume(self.folder / "model.ply", self.folder / "cavity.ply"), "")
        self.assertGreater((self.folder / "hollow.stl").stat().st_size, 50 * len(
            read_ply(self.folder / "cavity.ply")[1]))
        self.assertEqual(len(layers_of(self.folder / "hollow.mlp")), 2)
        self.assertEqual(len(layers_of(self.folder / "answer.mlp")), 5)


class PyMeshLabTest(unittest.TestCase):
    """Debian does not have it: the blocks are read, not run."""

    def test_blocks(self):
        listed = subprocess.run([os.environ["MASSPROPS_LIST_PARAMETERS"], "1"], check=True,
                                stdout=subprocess.PIPE).stdout.decode()
        names = {line.split("\t")[0] for line in listed.splitlines()}
        blocks = [block for block in shown(r"^```python\n(.*?)^```") if "pymeshlab." in block]
        self.assertTrue(blocks)
        for block in blocks:
            calls = [node for node in ast.walk(ast.parse(block)) if isinstance(node, ast.Call)
                     and getattr(node.func, "attr", "") in FILTER_CALLS]
            self.assertTrue(calls, block)
            for call in calls:
                self.assertLessEqual({keyword.arg for keyword in call.keywords}, names)
                for given in call.args:
                    self.assertEqual(ast.literal_eval(given), "mass_property_optimization")


if __name__ == "__main__":
    unittest.main()
