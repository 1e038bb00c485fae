#!/usr/bin/env python3
"""All that people open, as Chromium shows it from disk: reports, comparisons, indices and the manual. At the widths of a phone,
a tablet and a desk, in light and dark, nothing is said on the console, nothing is fetched from elsewhere, nothing goes beyond
the side, and axe-core (light on a phone, dark on a desk) finds nothing that keeps anybody from reading it."""

import html
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest
import urllib.parse

import browser
from support import FACETMILL, SCAN, SLOW, SOURCE, Case, main, png

AXE = pathlib.Path(os.environ.get("FACETMILL_BUILD", FACETMILL.parent)) / "conformance/node_modules/axe-core/axe.min.js"
FOUND = """axe.run(document, {preload: false, resultTypes: ["violations"]}).then((found) => found.violations.map((one) =>
  `${one.id}: ${one.help}: ${one.nodes.slice(0, 3).map((node) => node.html.slice(0, 120)).join(" | ")}`))"""
# The lightness of what is behind the text, 0 to 255.
GROUND = """[document.body, document.documentElement].map((e) => getComputedStyle(e).backgroundColor.match(/[\\d.]+/g).map(Number))
  .filter((c) => c.length < 4 || c[3] > 0).map((c) => (c[0] + c[1] + c[2]) / 3)[0]"""
WIDE = """[...document.querySelectorAll("body *")].filter((e) => !e.closest(".scroll, .md-typeset__scrollwrap, pre, svg, .md-sidebar") &&
  e.getBoundingClientRect().right > innerWidth + 1).map((e) => e.tagName + "." + e.className).slice(0, 5).join(" ")"""
ODD = "data:image/gif;base64,R0lGODlhAQABAAAAACw="


@unittest.skipIf(SLOW, "a browser waits for the release build")
class Looks(Case):
    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser() if browser.CHROMIUM else None
        cls.axe = AXE.read_text() if AXE.exists() else None
        if cls.browser:
            cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        super().setUp()
        browser.require(self)
        if not self.axe:
            browser.miss(self, "axe-core is missing (tests/conformance/setup.sh installs it)")

    def faults(self, path, folder=None, axe=True):
        """What is wrong with a page, light and dark. Files of its folder, if it has one, may be asked for."""
        page, found = self.browser, []
        within = folder.resolve().as_uri() + "/" if folder else None
        for dark in (False, True):
            page.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
            page.size(1400, 900)
            page.open(path)
            if folder:
                self.open_anew(path)
            found += page.problems + [f"asks for {url}" for url in page.requests if not within or not url.startswith(within)]
            if not page.comes_to(f"({GROUND} < 80) === {json.dumps(dark)}"):
                found.append(f"{'dark' if dark else 'light'}: the ground is of {page.do(GROUND)}")
            page.do("for (const part of document.querySelectorAll('details')) part.open = true")
            if self.axe and axe:
                page.do(self.axe + "; 0")
            for width in (390, 800, 1400):
                page.size(width, 900)
                if page.do("document.documentElement.scrollWidth") > width or page.do(WIDE):
                    found.append(f"{width}: beyond the side: {page.do(WIDE)}")
                page.do("for (const one of document.getAnimations()) one.finish()")  # colours that are on their way
                if self.axe and axe and width == (1400 if dark else 390):
                    found += [f"{'dark' if dark else 'light'}, {width}: {one}" for one in page.do(FOUND)]
        return found

    def open_anew(self, path):
        """The manual keeps the scheme that it was shown in."""
        self.browser.do("localStorage.clear()")
        self.browser.open(path)

    def test_faults_are_found(self):
        """What is looked for is seen where it is."""
        self.write("bad.html", f'<!DOCTYPE html><html><head><title>x</title></head><body style="color:#aaa;background:#fff"><main>'
                   f'<h1>Hardly seen</h1><img src="{ODD}"><div style="width:2000px">x</div><img alt="" src="https://nowhere.invalid/x.png">'
                   "</main></body></html>")
        found = "\n".join(self.faults(self.dir / "bad.html"))
        for words in ("asks for https://nowhere.invalid/x.png", "dark: the ground is of 255", "390: beyond the side: DIV",
                      "1400: beyond the side", *(("html-has-lang", "image-alt", "color-contrast") if self.axe else ())):
            self.assertIn(words, found)

    def textured(self):
        """A scan that has a texture, a second material, and a part of a name that is markup."""
        self.write("red.obj", "mtllib red.mtl\no <b>red</b>\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl red\n"
                   "f 1/1 2/2 3/3 4/4\no plain\nv 0 0 1\nv 1 0 1\nv 1 1 2\nusemtl blue\nf 5 6 7\n")
        self.write("red.mtl", "newmtl red\nmap_Kd red.png\nnewmtl blue\nKd 0 0 1\n")
        (self.dir / "red.png").write_bytes(png(255, 0, 0))

    def test_reports(self):
        self.mill("pipe", "-q", "--report", "good.html", "--timings", "times.html", "load", SCAN, "--unit", "mm", "!", "simplify", "20%",
                  "!", "relax", "1", "!", "write", "a-rather-long-name_of_a-file_" + "x" * 40 + ".glb")
        self.textured()
        self.mill("pipe", "-q", "--report", "bad.html", "load", "red.obj", "!", "measure", "--attributes", "mean_curvature", "!", "validate", "--closed",
                  "--faces.max", "2", expect=1)
        for name in ("good.html", "times.html", "bad.html"):
            self.assertEqual(self.faults(self.dir / name, axe=name != "times.html"), [], name)
        self.browser.open(self.dir / "good.html")
        self.browser.do("(() => { const s = document.querySelector('input[type=range]'); s.value = 70; s.dispatchEvent(new Event('input')); })()")
        self.assertEqual(self.browser.do("document.querySelector('figure.compared').style.getPropertyValue('--at')"), "70%")

    def test_comparisons_and_indices(self):
        self.textured()
        for folder in ("old/of/assets", "new/of/assets"):
            (self.dir / folder).mkdir(parents=True)
        self.mill("pipe", "-q", "load", "red.obj", "!", "write", "old/of/assets/scene.glb")
        self.mill("pipe", "-q", "load", "red.obj", "!", "transform", "--only", "plain", "--translate", "0,0,0.5", "!", "write",
                  "new/of/assets/scene.glb")
        self.write("old/of/assets/gone_from_here.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.mill("diff", "old/of/assets", "new/of/assets", "--html", "index.html", expect=1)
        for name in ("index.html", "index/scene.glb.html"):
            self.assertEqual(self.faults(self.dir / name, folder=self.dir if name == "index.html" else None), [], name)
        self.write("p.yaml", "facetmill: 1\nparams:\n  input: {type: path}\nstages:\n  - load: ${input}\n  - validate: {closed: true}\n"
                   "  - write: ${input.stem}.ply\n")
        self.mill("batch", "p.yaml", "--input", "*/of/assets/*", "-k", "-o", "out", "--report", "batch.html", expect=1)
        self.assertEqual(self.faults(self.dir / "out/batch.html"), [], "batch")

    def test_manual(self):
        self.need_site()
        run = subprocess.run([sys.executable, SOURCE / "tools/site/site.py", self.dir, "--mill", FACETMILL], capture_output=True, text=True,
                             timeout=300)
        self.assertEqual(run.returncode, 0, run.stderr)
        site = self.dir / "html"
        for name in ("index", "stages/simplify", "guides/scan-to-web", "web-assets", "gallery"):
            self.assertEqual(self.faults(site / f"{name}.html", folder=site, axe=name != "gallery"), [], name)
        self.links_lead_somewhere(site)
        self.switches(site)

    def need_site(self):
        if not browser.shutil.which("mkdocs") or not importlib.util.find_spec("yaml"):
            browser.miss(self, "mkdocs is missing (tools/deps.sh --site installs it)")
            self.skipTest("mkdocs is missing")

    def links_lead_somewhere(self, site):
        pages = {path: path.read_text() for path in site.rglob("*.html")}
        self.assertGreater(len(pages), 40)
        ids = {path: set(re.findall(r'\sid="([^"]+)"', text)) for path, text in pages.items()}
        links = 0
        for path, text in pages.items():
            for link in re.findall(r'\s(?:href|src)="([^"]+)"', re.sub(r"<pre>.*?</pre>", "", text, flags=re.S)):
                url = urllib.parse.urlsplit(html.unescape(link))
                if url.scheme:
                    continue
                target = (path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else path
                target = target / "index.html" if target.is_dir() else target
                self.assertTrue(target.exists(), f"{path.relative_to(site)}: {link}")
                if url.fragment and target.suffix == ".html":
                    links += 1
                    self.assertIn(urllib.parse.unquote(url.fragment), ids[target], f"{path.relative_to(site)}: {link}")
        self.assertGreater(links, 100)

    def switches(self, site):
        page = self.browser
        page.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "light"}])
        page.size(390, 900)
        self.open_anew(site / "stages/simplify.html")
        scheme = "document.body.dataset.mdColorScheme"
        self.assertEqual(page.do(scheme), "default")
        page.do("document.querySelector('[data-md-component=palette] label:not([hidden])').click()")
        page.wait(f"{scheme} === 'slate'")
        page.do("document.querySelector('label.md-header__button[for=__drawer]').click()")
        page.wait("document.getElementById('__drawer').checked")
        # On a phone an option is a card: its name, its type and all of what it does, one below the other.
        self.assertEqual(page.do("(() => { const cells = [...document.querySelector('table').rows[1].cells], at = cells.map((c) => "
                                 "c.getBoundingClientRect()); return [cells[1].dataset.head, at[1].top >= at[0].bottom - 1, "
                                 "at[3].width > 300]; })()"), ["type", True, True])


if __name__ == "__main__":
    main()
