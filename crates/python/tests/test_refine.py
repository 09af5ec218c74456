"""The lines of a map, as the program follows them."""

import json

import numpy as np
import pytest
import squealmap
from conftest import FIRST, document, number, table

LARGE = {
    "friction": {"law": "bilinear"},
    "belt": {"belt_velocity": 3.0},
    "axes": {
        "mu_s": {"from": 0.0, "to": 0.6, "points": 129},
        "mu_d": {"from": 0.0, "to": 0.6, "points": 129},
    },
    "analysis": ["linear"],
}


def test_what_is_computed_is_what_the_program_computes(tmp_path, program):
    squealmap.Sweep(keys=LARGE).write(tmp_path / "large.toml")
    words = ["refine", "large.toml", "-o", "out", "--coarse", "16", "--sample", "200", "--seed", "7"]
    ended = program(*words, cwd=tmp_path)
    assert ended.returncode == 0, ended.stderr
    made = squealmap.refine(LARGE, coarse=16, sample=200, seed=7)
    columns, told = table(tmp_path / "out/points.csv"), document(tmp_path / "out/refine.json")
    found = json.loads(made.attrs["refined"])
    assert 0 < found["computed"] == told["computed"] < 129 * 129 / 4
    assert found["share_missed_at_most_95_percent"] == told["sample"]["share_at_most_95_percent"]
    instances = [int(one) for one in columns["instance"]]
    computed = made["computed"].values.ravel()
    assert sorted(instances) == np.flatnonzero(computed).tolist()
    growth = made["growth_rate"].values.ravel()
    assert np.array_equal(growth[instances], [number(one) for one in columns["growth_rate"]], equal_nan=True)
    assert made.squealmap.names("type").values.ravel()[instances].tolist() == columns["type"]
    # What was not computed has the type of the whole map, but for what the sample bounds.
    whole = squealmap.linear(LARGE)["type"].values
    assert np.isnan(growth[computed == 0]).all()
    assert np.mean(whole != made["type"].values) <= found["share_missed_at_most_95_percent"]
    assert made.squealmap.plot().svg


def test_refine_of_a_sweep_is_that_of_the_call():
    given = {**LARGE, "refine": {"coarse": 8, "sample": 50, "seed": 3}}
    made, called = squealmap.refine(given), squealmap.refine(LARGE, coarse=8, sample=50, seed=3)
    assert made.drop_attrs().identical(called.drop_attrs())
    with pytest.raises(squealmap.InputError, match="squealmap.refine"):
        squealmap.run(given)
    assert squealmap.linear(given)["growth_rate"].notnull().all()


def test_progress_grows():
    bars = []

    class Bar:
        def __init__(self, total, unit):
            self.total, self.done = total, 0
            bars.append(self)

        def update(self, count):
            self.done += count

        def close(self):
            pass

    made = squealmap.refine(LARGE, progress=Bar)
    assert bars[0].done == bars[0].total == int(made["computed"].sum())


def test_what_is_refused():
    for keys, words in [
        ({"coarse": 1}, "coarse is 1 but must be from 2 to 4096"),
        ({"coarse": 5000}, "coarse is 5000"),
        ({"sample": -1}, "sample is -1"),
        ({"seed": 2**64}, "seed is"),
        ({"backend": "tpu"}, "backend"),
    ]:
        with pytest.raises(squealmap.InputError, match=words):
            squealmap.refine(LARGE, **keys)
    with pytest.raises(squealmap.InputError, match="two numeric axes"):
        squealmap.refine({**LARGE, "friction": {"law": "bilinear", "mu_d": 0.2}, "axes": {"mu_s": {"values": [0.1, 0.2]}}})
    for keys in [{"coarse": "16"}, {"coarse": True}, {"sample": 1.5}, {"seed": []}]:
        with pytest.raises(TypeError):
            squealmap.refine(LARGE, **keys)
