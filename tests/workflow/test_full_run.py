"""One full run of the quick configuration, by the real snakemake."""

from latticode.datasets.digest import fingerprint


def test_every_picture_shows_what_is_described_beside_it(full_run):
    described = sorted((full_run / "results/figures").glob("*.json"))
    assert len(described) >= 15
    for path in described:
        mark = fingerprint(path.read_text(encoding="utf-8")).encode()
        png, pdf = (path.with_suffix(kind).read_bytes() for kind in (".png", ".pdf"))
        assert png.startswith(b"\x89PNG") and pdf.startswith(b"%PDF")
        assert mark in png and mark in pdf, path.name
