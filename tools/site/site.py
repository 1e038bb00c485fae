#!/usr/bin/env python3
"""site.py FOLDER [--mill FACETMILL] [--pages]: the manual as a site that works without a server or a network.

Pages: the README, the guides and pages of docs/, a page for each stage (from its declaration, with pictures before and after
it that are rendered here), a gallery of these, and one for all errors and warnings. Builds FOLDER/html with MkDocs, which refuses links that lead
nowhere; --pages stops before that, with the Markdown in FOLDER/pages.
"""
import argparse
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

import yaml

SOURCE = pathlib.Path(__file__).resolve().parents[2]
HERE = SOURCE / "tools/site"
GUIDES = ["scan-to-web", "levels-of-detail", "printing", "checks", "units-and-axes", "asset-builds"]
PAGES = ["pipelines", "figures", "glossary", "verdicts", "speed", "web-assets", "large-meshes", "tiles", "reliability",
         "cluster", "architecture", "licences"]


class Site:
    def __init__(self, folder, mill):
        self.pages, self.mill = folder / "pages", mill
        self.pages.mkdir(parents=True)
        self.titles = {}

    def run(self, *words, **more):
        return subprocess.run([str(self.mill), *words], check=True, capture_output=True, text=True, **more).stdout

    def put(self, name, text):
        """A page; links to files of the sources that have no page become plain text."""
        folder = (self.pages / name).parent
        folder.mkdir(parents=True, exist_ok=True)
        text = re.sub(r"(?<!!)\[([^\]]+)\]\((?!https?:|#)([^)#]+)(#[^)]*)?\)",
                      lambda m: self.link(name, m[1], m[2], m[3] or ""), text)
        (self.pages / name).write_text(text)
        self.titles[name] = re.match(r"# (.+)", text)[1]

    def link(self, page, words, target, anchor):
        path = (pathlib.Path("docs" if page != "index.md" else ".") / target).as_posix()
        name = re.sub(r"^(\./|docs/\.\./|docs/)", "", path)
        name = {"README.md": "index.md", "stages.md": "stages/index.md"}.get(name, name)
        if name.removesuffix(".md") in PAGES + GUIDES or name in ("index.md", "stages/index.md") or name.startswith("guides/"):
            up = "../" * page.count("/")
            return f"[{words}]({up}{name}{anchor})"
        return words

    @staticmethod
    def commands(scene, picture):
        """The words of the commands that make a picture of the scene: those between && in its text, of which the last one
        ends in render, if only with its path."""
        *first, last = [shlex.split(command) for command in scene.split(" && ")]
        if "render" in last:
            at = last.index("render") + 1
            last = [*last[:at], picture, *last[at:]]
        else:
            last = [*last, "!", "render", picture]
        return [["pipe", *words] for words in [*first, last]]

    def pictures(self, stage, scenes):
        """The Markdown of the scenes before and after a stage."""
        text = ""
        for number, scene in enumerate(scenes):
            picture = f"{stage}-{number}.png"
            for words in self.commands(scene, str(self.pages / "stages" / picture)):
                size = ["--width", "480", "--height", "360"] if "render" in words else []
                self.run(*words, *size, cwd=self.pages.parent)
            lines = "".join(f"facetmill {' '.join(words)}\n" for words in self.commands(scene, picture))
            text += f"\n```sh\n{lines}```\n\n![{scene}]({picture})\n"
        return text

    def stage_pages(self):
        scenes = yaml.safe_load((HERE / "pictures.yaml").read_text())
        parts = re.split(r"\n## (?=[a-z-]+\n)", self.run("stages", "--markdown"))
        (self.pages / "stages").mkdir()
        shutil.copy(SOURCE / "examples/data/nefertiti.ply", self.pages.parent / "scan.ply")
        shutil.copy(SOURCE / "tests/data/box-textured.glb", self.pages.parent / "crate.glb")
        names = [part.split("\n", 1)[0] for part in parts[1:]]
        if unknown := set(scenes) - set(names):
            sys.exit(f"pictures.yaml names what is no stage: {', '.join(sorted(unknown))}")
        for name, part in zip(names, parts[1:]):
            about, rest = part.split("\n", 1)[1].lstrip().split("\n", 1)
            self.put(f"stages/{name}.md", f"# {name}\n\n{about}\n{self.pictures(name, scenes.get(name, []))}\n{rest}")
        overview = re.sub(r"^\| `([a-z-]+)` \|", r"| [`\1`](\1.md) |", parts[0], flags=re.M)
        (self.pages / "stages/index.md").write_text(overview)
        self.titles["stages/index.md"] = "All stages"
        return ["stages/index.md"] + [f"stages/{name}.md" for name in names]

    def gallery(self, stages):
        """All pictures of the stages, each stage's beside each other, and the figures."""
        text = ("# Gallery\n\nWhat the stages do, before and after; the commands are on the page of each. `make pictures` "
                "makes all pictures anew. More: [figures](figures.md) after the notes that facetmill is based on.\n")
        for name in stages:
            pictures = sorted((self.pages / "stages").glob(f"{name}-[0-9].png"))
            if pictures:
                cells = " | ".join(f"![{name}](stages/{picture.name})" for picture in pictures)
                heads = " | ".join(("before", "after")[-len(pictures):])
                text += f"\n## [{name}](stages/{name}.md)\n\n| {heads} |\n|{'---|' * len(pictures)}\n| {cells} |\n"
        (self.pages / "gallery.md").write_text(text)
        self.titles["gallery.md"] = "Gallery"

    def fill(self):
        self.put("index.md", (SOURCE / "README.md").read_text().replace("](docs/figures/", "](figures/"))
        for name in GUIDES:
            self.put(f"guides/{name}.md", (SOURCE / "docs/guides" / f"{name}.md").read_text())
        for name in PAGES:
            self.put(f"{name}.md", (SOURCE / "docs" / f"{name}.md").read_text())
        shutil.copytree(SOURCE / "docs/figures", self.pages / "figures")
        for name in ("site.css", "site.js"):
            shutil.copy(HERE / name, self.pages)
        stages = self.stage_pages()
        self.gallery([pathlib.PurePath(page).stem for page in stages[1:]])
        self.put("messages.md", self.run("explain", "--markdown"))

        def titled(names):
            return [{self.titles[name]: name} for name in names]
        return [{"facetmill": "index.md"}, {"Guides": titled(f"guides/{name}.md" for name in GUIDES)},
                {"Gallery": "gallery.md"}, {"Stages": titled(stages)}, {"More": titled([f"{name}.md" for name in PAGES])},
                {"Errors and warnings": "messages.md"}]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--mill", type=pathlib.Path, default=SOURCE / "build/release/facetmill")
    parser.add_argument("--pages", action="store_true", help="the Markdown only")
    options = parser.parse_args()
    folder = options.folder.resolve()
    for old in ("pages", "html"):
        shutil.rmtree(folder / old, ignore_errors=True)
    settings = yaml.safe_load((HERE / "mkdocs.yml").read_text())
    settings["nav"] = Site(folder, options.mill.resolve()).fill()
    (folder / "mkdocs.yml").write_text(yaml.safe_dump(settings, sort_keys=False))
    if not options.pages:
        subprocess.run(["mkdocs", "build", "--quiet", "--config-file", str(folder / "mkdocs.yml")], check=True)
        (folder / "html/404.html").unlink()  # a server's; its links lead nowhere in a folder
        print(f"Look at {folder}/html/index.html.")


if __name__ == "__main__":
    main()
