"""Instances given as arrays are those of a file of points."""

import numpy as np
import pytest
import squealmap
from conftest import FIRST, table
from test_map import compare

REST = {"friction": {"knee_velocity": 5.0, "stribeck_velocity": 0.5}, "response": {"settle": "4 periods", "measure": "8 periods"}}

POINTS = {
    "mu_s": np.linspace(0.31, 0.6, 30),
    "mu_d": np.full(30, 0.2, dtype=np.float32),
    "belt_velocity": np.tile([1, 2, 3], 10),
    "law": ["bilinear", "exponential"] * 15,
}

HEAD = '''
friction.knee_velocity = 5.0
friction.stribeck_velocity = 0.5
response.settle = "4 periods"
response.measure = "8 periods"
'''


def rows(points):
    """As the text of a file; numbers as Python writes them in full."""
    columns = [[one if isinstance(one, str) else repr(float(one)) for one in column] for column in points.values()]
    return "".join(",".join(row) + "\n" for row in [list(points), *zip(*columns)])


def test_the_map_of_the_program_in_every_value(tmp_path, program):
    (tmp_path / "points.csv").write_text(rows(POINTS))
    (tmp_path / "sweep.toml").write_text('points = "points.csv"\n' + HEAD)
    ended = program("run", "sweep.toml", "-o", "out", cwd=tmp_path)
    assert ended.returncode == 0, ended.stderr
    made = squealmap.run({**REST, "points": POINTS})
    columns = table(tmp_path / "out/map.csv")
    assert dict(made.sizes) == {"instance": 30}
    assert compare(made, columns) == len(columns) - 1
    assert made.drop_attrs().identical(squealmap.run(tmp_path / "sweep.toml").drop_attrs())
    # Another value is told.
    other = squealmap.run({**REST, "points": {**POINTS, "mu_s": np.nextafter(POINTS["mu_s"], 1)}})
    with pytest.raises(AssertionError):
        compare(other, columns)


def test_a_sweep_takes_them_too():
    sweep = squealmap.Sweep(keys=REST).points(POINTS)
    made = squealmap.linear({**REST, "points": POINTS})
    assert squealmap.linear(sweep).drop_attrs().identical(made.drop_attrs())
    lists = {name: list(column) for name, column in POINTS.items()}
    assert squealmap.linear({**REST, "points": lists}).drop_attrs().identical(made.drop_attrs())
    with pytest.raises(TypeError, match="as CSV"):
        str(sweep)


def test_a_part_of_a_dataset_gives_points():
    """What one sweep found is where the next one looks."""
    made = squealmap.linear(FIRST).stack(point=["mu_s", "belt_velocity"])
    chosen = made.where(made["growth_rate"] > 0, drop=True).reset_index("point")
    points = {name: chosen[name] for name in ["mu_s", "belt_velocity"]}
    again = squealmap.linear({"friction": FIRST["friction"], "points": points})
    assert np.array_equal(again["growth_rate"], chosen["growth_rate"])


def test_what_is_refused():
    for points, words in [
        ({"mu_s": [0.5, 0.4], "mu_d": [0.2]}, "`mu_d` has 1 values but `mu_s` has 2"),
        ({"mu_s": [0.5, -0.4]}, "mu_s"),
        ({"mu_s": [0.5, float("nan")]}, "mu_s"),
        ({"mu_s": [10**400]}, "mu_s"),
        ({"mass": [1.0]}, "mass"),
        ({"law": ["coulomb"]}, "coulomb"),
        ({"law": ['"']}, "law"),
        ({"law": ["a\nb"]}, "close"),
        ({"mu_s,mu_d": [0.5]}, "mu_s,mu_d"),
        ({"mu_s": []}, ""),
        ({}, ""),
    ]:
        with pytest.raises(squealmap.InputError) as raised:
            squealmap.run({**REST, "belt": {"belt_velocity": 3.0}, "points": points})
        assert words in str(raised.value), raised.value
    with pytest.raises(squealmap.InputError, match="axes"):
        squealmap.run({**FIRST, "points": POINTS})
    for wrong in [
        {1: [0.5]},
        {"mu_s": 0.5},
        {"mu_s": "0.5"},
        {"mu_s": np.float64(0.5)},
        {"mu_s": [[0.5]]},
        {"mu_s": np.ones((2, 2))},
        {"mu_s": [True]},
        {"mu_s": [None]},
        {"mu_s": [0.5, "0.4"]},
        {"mu_s": {"a": 1}},
        {"law": ["\ud800"]},
        {"\ud800": [0.5]},
    ]:
        with pytest.raises(TypeError):
            squealmap.run({**REST, "points": wrong})
