"""What is kept of long studies for the documents, made of the accepted shorter ones."""

import keep
from accepted import BASELINE, dataset
from latticode.datasets.netcdf import read


def test_what_is_kept_has_the_form_of_what_is_quoted(tmp_path):
    (tmp_path / "long").symlink_to(BASELINE)
    (tmp_path / "unbounded").symlink_to(BASELINE / "unbounded")
    keep.main(tmp_path, tmp_path / "quoted")
    found = {}
    for name in ("unbounded", "pendula", "breathers"):
        found[name], quoted = read(tmp_path / f"quoted/{name}.nc"), dataset(f"quoted/{name}")
        kept, known = ({key: one.dims for key, one in data.variables.items()}
                       for data in (found[name], quoted))  # fmt: skip
        assert kept.items() <= known.items()
    assert (found["breathers"]["fate"] == dataset("breathers/fates")["fate"]).all()
    chain, long = found["unbounded"], dataset("quoted/unbounded")
    assert chain["power_behind"].equals(dataset("unbounded/fronts")["power_behind"])
    off = {"speed": 0.05, "exponent": 0.05}
    first = {name: abs(chain[name] - long[name])[0] for name in off}
    assert all(first[name] < most for name, most in off.items()), first
