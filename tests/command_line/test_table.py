"""The table of parameters is what the dialog, the help, the scripts and docs/parameters.md have."""
import json
import os
import re
import subprocess
import unittest
import xml.etree.ElementTree as xml

from host import ROOT, SAMPLES
from program import ProgramTest


class TableTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.table = json.loads(self.run_program("--describe", "json")[0])
        self.rows = {row["name"]: row for row in self.table}

    def test_it_is_the_dialogs(self):
        done = subprocess.run([os.environ["MASSPROPS_LIST_PARAMETERS"], "100"], check=True,
                              stdout=subprocess.PIPE)
        dialog = [line.split("\t") for line in done.stdout.decode().splitlines()]
        self.assertEqual([[r["name"], r["label"] + (f" [{r['unit']}]" if r["unit"] else ""),
                           r["help"]] for r in self.table], dialog)

    def test_help_has_every_parameter(self):
        listed = re.findall(r"^  (-[-\w,]+)", self.run_program("--help")[0], re.MULTILINE)
        options = [name for names in listed for name in names.split(",")]
        for name in self.rows:
            if name == "show_layers":  # a file here: --answer
                continue
            option = "--" + name.replace("_", "-")
            off = "--no-" + name.replace("_", "-")
            self.assertEqual(options.count(option) + options.count(off), 1, name)

    def test_the_page_explains_every_parameter_and_its_default(self):
        text = (ROOT / "docs" / "parameters.md").read_text(encoding="utf-8")
        table = re.search(r"^\| name \|.*?\n\n", text, re.MULTILINE | re.DOTALL).group()
        explained = {}
        for line in table.splitlines():
            if line.startswith("| `"):
                names, default = line.split("|")[1:3]
                names = re.findall(r"`(\w+)`", names)
                defaults = [d.strip() for d in default.split(",")]
                for i, name in enumerate(names):
                    explained[name] = defaults[min(i, len(defaults) - 1)]
        self.assertEqual(set(explained), set(self.rows))
        for name, default in explained.items():
            row = self.rows[name]
            if row["kind"] == "choice":
                wanted = row["entries"][row["default"]]
            elif row["kind"] == "length":
                share = row["default_share_of_diagonal"]
                wanted = f"{100 * share:g} % of the diagonal" if share else "0"
            elif row["kind"] == "switch":
                wanted = str(row["default"]).lower()
            else:
                wanted = f"{row['default']:g}" if row["kind"] != "file" else row["default"]
            self.assertEqual(default, wanted, name)

    def test_every_script_lists_every_parameter(self):
        for script in sorted(SAMPLES.glob("*.mlx")):
            with self.subTest(script.name):
                parameters = xml.parse(script).findall(".//Param")
                self.assertEqual({p.get("name") for p in parameters}, set(self.rows))
                for p in parameters:
                    entries = self.rows[p.get("name")]["entries"]
                    if p.get("type") == "RichEnum":
                        listed = [p.get(f"enum_val{i}") for i in range(len(entries))]
                        self.assertEqual(listed, entries)
                        self.assertEqual(p.get("enum_cardinality"), str(len(entries)))

    def test_the_coming_meshlab_can_read_it(self):
        """Its rules: docs/design/adding_a_filter.md and vocabulary.md of its repository."""
        file = json.loads(self.run_program("--describe", "filters")[0])
        (told,) = file["filters"]
        self.assertEqual(told["referenceIds"], [one["id"] for one in file["references"]])
        self.assertNotRegex(told["shortDescription"], r"[\n*`$<\[]")
        self.assertEqual([p["id"] for p in told["parameters"]], [r["name"] for r in self.table])
        types = {"switch": "bool", "whole number": "int", "number": "double", "share": "double",
                 "length": "absperc", "choice": "enum", "file": "filesave"}
        shares = {"@bboxDiag01": 0.01}
        for parameter, row in zip(told["parameters"], self.table):
            with self.subTest(row["name"]):
                self.assertEqual(parameter["type"], types[row["kind"]])
                self.assertTrue(parameter["label"] and parameter["help"])
                self.assertEqual(parameter["group"].startswith("advanced"), row["advanced"])
                self.assertNotIn("\\n", parameter["help"])
                default = parameter["default"]
                if row["kind"] == "length":
                    self.assertEqual(shares.get(default, default), row["default_share_of_diagonal"])
                    self.assertEqual((parameter["min"], parameter["max"]), (0, "@bboxDiag"))
                elif row["kind"] == "choice":
                    self.assertEqual([o["id"] for o in parameter["enumOptions"]], row["entries"])
                    self.assertEqual(default, row["entries"][row["default"]])
                else:
                    self.assertEqual(default, row["default"])


if __name__ == "__main__":
    unittest.main()
