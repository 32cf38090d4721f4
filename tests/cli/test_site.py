"""The documents as a site: links and anchors lead somewhere, the pages ask for nothing outside, the commands are the program's."""

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from support import ROOT, ZLG, folder_until

LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"```.*?^```|`[^`\n]*`", re.MULTILINE | re.DOTALL)


def documents():
    listed = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / "tests").glob("*.md")]
    return sorted(listed)


def anchors_of(page):
    """The anchors of the headings of a page, as GitHub makes them."""
    made = set()
    for heading in re.findall(r"^#+ (.+)$", re.sub(r"```.*?^```", "", page.read_text(), flags=re.M | re.S), re.MULTILINE):
        anchor = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()).replace(" ", "-")
        while anchor in made:
            anchor += "-1"
        made.add(anchor)
    return made


class Links(unittest.TestCase):
    def test_every_link_and_anchor_of_the_documents_exists(self):
        checked = 0
        for page in documents():
            for link in LINK.findall(CODE.sub("", page.read_text())):
                parts = urlsplit(link)
                if parts.scheme:
                    continue
                target = page if not parts.path else (page.parent / unquote(parts.path)).resolve()
                with self.subTest(page=page.relative_to(ROOT), link=link):
                    self.assertTrue(target.exists(), "no such file")
                    if parts.fragment and target.suffix == ".md":
                        self.assertIn(unquote(parts.fragment), anchors_of(target))
                checked += 1
        self.assertGreater(checked, 100)

    def test_every_page_of_the_documents_is_in_the_contents_of_the_site(self):
        named = set(re.findall(r": (docs/\S+\.md)$", (ROOT / "mkdocs.yml").read_text(), re.MULTILINE))
        self.assertEqual(named, {str(page.relative_to(ROOT)) for page in (ROOT / "docs").rglob("*.md")})


class Verbs(unittest.TestCase):
    def test_the_page_of_the_commands_is_what_the_program_says(self):
        made = subprocess.run([sys.executable, ROOT / "tools" / "document_verbs", ZLG], capture_output=True, text=True, check=True).stdout
        self.assertEqual((ROOT / "docs" / "verbs.md").read_text(), made, "renew it: tools/document_verbs > docs/verbs.md")


class Page(HTMLParser):
    """What a page makes a browser load, where it leads, and its anchors."""

    def __init__(self, text):
        super().__init__()
        self.loads, self.leads, self.anchors = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        if "id" in given:
            self.anchors.add(given["id"])
        if tag == "a" and given.get("href"):
            self.leads.append(given["href"])
        elif tag != "a":
            self.loads += [given[name] for name in ("src", "href", "data", "poster", "srcset") if given.get(name)]


def outside(address):
    return bool(urlsplit(address).netloc) or urlsplit(address).scheme not in ("", "data")


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if shutil.which("mkdocs") is None:
            raise unittest.SkipTest("mkdocs is not installed: scripts/install site")
        folder = folder_until(cls.addClassCleanup)
        cls.site = folder / "site"
        cls.built = subprocess.run([ROOT / "scripts" / "site", "--strict", "--out", cls.site], capture_output=True, text=True)
        cls.pages = {page: Page(page.read_text()) for page in cls.site.rglob("*.html")}

    def test_it_is_built_without_a_warning_and_says_where(self):
        self.assertEqual(self.built.returncode, 0, self.built.stderr)
        self.assertEqual(self.built.stdout.splitlines()[-1], f"{self.site}/index.html")
        self.assertGreater(len(self.pages), 28)

    def test_no_page_style_or_picture_loads_anything_from_outside(self):
        for path, page in self.pages.items():
            for address in page.loads:
                self.assertFalse(outside(address), f"{path}: {address}")
                # A server shows 404.html in place of any page: its addresses are from the root.
                if path.name != "404.html" and not address.startswith("data:"):
                    self.assertTrue((path.parent / unquote(urlsplit(address).path)).exists(), f"{path}: {address}")
        for path in [*self.site.rglob("*.css"), *self.site.rglob("*.svg")]:
            text = path.read_text(errors="replace")
            for address in re.findall(r"url\(\s*['\"]?([^)'\"]+)|@import\s+['\"]([^'\"]+)|xlink:href=\"([^\"#]+)", text):
                self.assertFalse(outside("".join(address)), f"{path}: {address}")

    def test_it_holds_the_lab_page_of_the_build(self):
        lab = ROOT / "build" / "release" / "share" / "zlg" / "lab.html"
        if not lab.exists():
            self.skipTest("the build holds no lab page: scripts/lab")
        self.assertEqual((self.site / "docs" / "lab_page.html").read_bytes(), lab.read_bytes())
        self.assertIn("lab_page.html", self.pages[self.site / "docs" / "lab.html"].leads)

    def test_every_link_between_pages_and_every_anchor_exists(self):
        for path, page in self.pages.items():
            if path.name in ("404.html", "search.html"):
                continue  # their links are those of the theme, from the root of a server
            for address in page.leads:
                parts = urlsplit(address)
                if outside(address) or address.startswith("#") and len(address) == 1:
                    continue
                target = (path.parent / unquote(parts.path)).resolve() if parts.path else path.resolve()
                self.assertTrue(target.exists(), f"{path}: {address}")
                if parts.fragment and target.suffix == ".html":
                    self.assertIn(unquote(parts.fragment), self.pages[self.site.resolve() / target.relative_to(self.site.resolve())].anchors,
                                  f"{path}: {address}")

    def test_a_folder_that_is_no_site_and_an_unknown_argument_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "thesis.txt").write_text("mine")
            done = subprocess.run([ROOT / "scripts" / "site", "--out", folder], capture_output=True, text=True)
            self.assertEqual((done.returncode, (Path(folder) / "thesis.txt").read_text()), (2, "mine"))
            self.assertIn(folder, done.stderr)
        self.assertEqual(subprocess.run([ROOT / "scripts" / "site", "--open"], capture_output=True).returncode, 2)
