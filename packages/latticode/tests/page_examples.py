"""The examples of the library's pages: what they compute, and the pictures that they draw.

Run as `python packages/latticode/tests/page_examples.py` from anywhere: it draws each picture whose
example has changed, from the `figure` that the example makes. A picture holds the digest of its
example, so that a test finds an old one.
"""

import doctest
import hashlib
import io
import linecache
import re
import tempfile
from contextlib import chdir, redirect_stdout
from pathlib import Path

import matplotlib as mpl
from PIL import Image
from PIL.PngImagePlugin import PngInfo

HOME = Path(__file__).resolve().parents[1]
PAGES = sorted((HOME / "docs").glob("*.md"))
GALLERY = sorted(page for page in (HOME / "docs/gallery").glob("*.md") if page.stem != "README")
ILLUSTRATED = [HOME / "README.md", *PAGES, *GALLERY]
DIGEST = "Example"
"""The key of the digest among the texts of a picture."""
COLOURS = 64
"""So many are enough for a plot, and make a small file."""


def code_of(page: Path) -> str:
    """Return the Python code of a page: that of its blocks `python` and `pycon`."""
    blocks = re.findall(r"^```(python|pycon)\n(.*?)^```", page.read_text("utf-8"), re.M | re.S)
    examples_in = doctest.DocTestParser().get_examples
    return "\n".join(
        code if kind == "python" else "".join(example.source for example in examples_in(code))
        for kind, code in blocks
    )


def picture_of(page: Path) -> Path:
    """Return the path of the picture with which a page begins."""
    link = re.search(r"^!\[[^]]+\]\(([^)]+)\)$", page.read_text("utf-8"), re.M)
    if link is None:
        raise ValueError(f"{page}: link a picture below its title, ![text](pictures/x.png)")
    return page.parent / link[1]


def digest_of(page: Path) -> str:
    """Return the SHA-256 of the code of a page."""
    return hashlib.sha256(code_of(page).encode()).hexdigest()


def digest_in(picture: Path) -> str:
    """Return the digest of the example that drew a picture."""
    with Image.open(picture) as image:
        return image.info.get(DIGEST, "")


def run_page(page: Path) -> dict:
    """Return the variables of a page's example after it has run, in a folder of its own."""
    code, name, variables = code_of(page), f"<{page.stem}>", {"__name__": page.stem}
    # where a model reads the source of its functions
    linecache.cache[name] = len(code), None, code.splitlines(keepends=True), name
    with tempfile.TemporaryDirectory() as folder, chdir(folder), redirect_stdout(io.StringIO()):
        exec(compile(code, name, "exec"), variables)
    return variables


def draw_picture(page: Path, picture: Path) -> None:
    """Run the example of a page and write its figure with few colours, which makes a small file."""
    rendered, texts = io.BytesIO(), PngInfo()
    run_page(page)["figure"].savefig(rendered, dpi=100)
    texts.add_text(DIGEST, digest_of(page))
    image = Image.open(rendered).convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
    picture.parent.mkdir(exist_ok=True)
    image.save(picture, optimize=True, pnginfo=texts)


if __name__ == "__main__":
    mpl.use("agg")
    for page in ILLUSTRATED:
        picture = picture_of(page)
        if not picture.exists() or digest_in(picture) != digest_of(page):
            draw_picture(page, picture)
            print(f"{picture.relative_to(HOME)} is new")
