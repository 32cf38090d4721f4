"""The pages say what happened, need nothing from outside, and can be made again from themselves."""

import html
import json
import re
import unittest
from xml.etree import ElementTree

from support import folder_until, run

FAULT = ["--set", 'faults.kind=["laser_off"]', "--set", "faults.at_s=[3]", "--set", "faults.duration_s=[0.5]", "--set", "faults.size=[0]"]


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = folder_until(cls.addClassCleanup)
        cls.made = {}
        for name, arguments in {"short": ["--duration", "1"], "calm": ["--duration", "8"], "fault": ["--duration", "8", *FAULT],
                                "switched": ["--duration", "12", "--seed", "5", "--set", "switching.interval_s=3"]}.items():
            out = cls.folder / name
            result = run("run", *arguments, "--out", out, "--format", "csv")
            page = out / "report.html"
            cls.made[name] = page.read_text() if page.exists() else result.stderr
        for verb, inputs in {"design": [], "analyze": [cls.folder / "switched" / "angles.csv"]}.items():
            result = run(verb, *inputs, "--out", cls.folder / f"{verb}.html")
            assert result.returncode == 0, result.stderr
            cls.made[verb] = (cls.folder / f"{verb}.html").read_text()

    def test_a_fault_is_named_with_what_the_core_made_of_it(self):
        page = self.made["fault"]
        self.assertIn("What was made to fail", page)
        row = re.search(r'<th scope="row">light_lost</th><td class="n">([^<]*)</td><td class="n">([^<]*)</td>', page)
        self.assertAlmostEqual(float(row[1]), 3.0, delta=0.01)
        self.assertGreater(float(row[2]), 0.4)
        self.assertNotIn("<h2>Faults</h2>", self.made["calm"])

    def test_each_is_well_formed_with_one_small_script_and_nothing_from_outside(self):
        for name, page in self.made.items():
            with self.subTest(name):
                ElementTree.fromstring(re.search(r"<body>.*</body>", page, re.DOTALL)[0])
                scripts = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
                self.assertEqual(len(scripts), 1)
                self.assertLessEqual(len(scripts[0].encode()), 10240)
                self.assertNotRegex(page, r"(?i)https?:|\bsrc=|@import|<link|url\([^#]")

    def test_numbers_are_set_as_in_print(self):
        for name, page in self.made.items():
            body = re.search(r"<main>.*?<h2>How this page", page, re.DOTALL)[0]
            shown = " ".join(re.findall(r">([^<]+)<", re.sub(r"<details.*?</details>", "", body, flags=re.DOTALL)))
            self.assertNotRegex(shown, r"\+-|\de[+-]?\d|\^\d|sqrt\(|(^|\s)-\d", name)

    def test_the_page_holds_what_makes_the_run_again(self):
        page = self.made["switched"]
        own = html.unescape(re.search(r"<pre>(.*?)</pre>", page, re.DOTALL)[1])
        made = self.folder / "made.toml"
        made.write_text(own)
        again = run("run", "--config", made, "--out", self.folder / "again", "--format", "csv", "--json")
        self.assertEqual(again.returncode, 0, again.stderr)
        before = json.loads((self.folder / "switched" / "summary.json").read_text())
        self.assertEqual(json.loads(again.stdout)["variants"], before["variants"])
        self.assertIn("seed 5", page)
        self.assertRegex(page, r"zlg \d+\.\d+\.\d+")
        self.assertEqual((self.folder / "again" / "report.html").read_text(), page)
