"""Datasets draw themselves as the program draws its directories."""

import re

import numpy as np
import pytest
import squealmap
from conftest import FIRST, ROOT
from test_studies import pictures


def test_a_map_is_drawn_as_the_program_draws_it(first):
    dataset = squealmap.run(first / "first.toml")
    made, wanted = dataset.squealmap.plot(), (first / "out/map.svg").read_text()
    assert pictures(made.svg) == pictures(wanted)
    assert "/tmp" not in made.svg
    # Another value is another picture.
    other = dataset.copy(deep=True)
    other["type"].values[:] = 0
    assert pictures(other.squealmap.plot().svg) != pictures(wanted)


def test_options_are_those_of_plot(first, program):
    dataset = squealmap.run(first / "first.toml")
    for keys, words in [
        ({"quantity": ["growth", "x2_std"], "levels": 4}, ["--quantity", "growth,x2_std", "--levels", "4"]),
        ({"journal": "elsevier-1col", "title": ""}, ["--journal", "elsevier-1col", "--title", ""]),
        ({"cut": {"belt_velocity": 1.3}}, ["--cut", "belt_velocity=1.3"]),
        ({"width": 120, "hatch": True}, ["--width", "120", "--hatch"]),
    ]:
        assert program("plot", "out", "-o", "plot", *words, cwd=first).returncode == 0
        made = dataset.squealmap.plot(**keys).svg
        assert pictures(made) == pictures((first / "plot/plot.svg").read_text()), keys
    for keys, words in [
        ({"quantity": "colour"}, "no quantity `colour`"),
        ({"width": 1}, "width"),
        ({"journal": "nature-3col"}, "nature-3col"),
        ({"isolines": [0.1]}, "lines of equal value"),
        ({"cut": "mass=1"}, "mass"),
    ]:
        with pytest.raises(squealmap.InputError, match=re.escape(words)):
            dataset.squealmap.plot(**keys)


def test_a_part_of_a_map_is_drawn():
    dataset = squealmap.run(FIRST)
    part = dataset.isel(mu_s=slice(1, 4), belt_velocity=slice(None, None, 2))
    assert "<svg" in part.squealmap.plot().svg
    assert "<svg" in dataset.isel(mu_s=2).squealmap.plot().svg
    only = dataset[["type", "status", "growth_rate"]]
    assert "<svg" in only.squealmap.plot("growth_rate").svg


@pytest.mark.parametrize("name", ["tuples", "bistable_band", "temperature_map"])
def test_other_maps(name, tmp_path, program):
    assert program("run", ROOT / f"sweeps/{name}.toml", "-o", tmp_path).returncode == 0
    made = squealmap.run(ROOT / f"sweeps/{name}.toml").squealmap.plot()
    assert pictures(made.svg) == pictures((tmp_path / "map.svg").read_text())


def test_modes_and_traces(first, program):
    assert program("modes", "first.toml", "-o", "modes", cwd=first).returncode == 0
    made = squealmap.modes(first / "first.toml").squealmap.plot()
    assert pictures(made.svg) == pictures((first / "modes/modes.svg").read_text())
    assert program("trace", "first.toml", "--at", "mu_s=0.3,belt_velocity=1", "-o", "cell", cwd=first).returncode == 0
    made = squealmap.trace(first / "first.toml", "mu_s=0.3,belt_velocity=1").squealmap.plot()
    assert pictures(made.svg) == pictures((first / "cell/trace.svg").read_text())


def test_figures_are_saved(tmp_path):
    figure = squealmap.linear(FIRST).squealmap.plot()
    for ending, begin in [("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")]:
        figure.save(tmp_path / f"map.{ending}")
        assert (tmp_path / f"map.{ending}").read_bytes().startswith(begin)
    with pytest.raises(squealmap.InputError, match="jpg"):
        figure.save(tmp_path / "map.jpg")
    assert figure._repr_svg_() == figure.svg


def test_what_is_no_dataset_of_this_package():
    import xarray

    with pytest.raises(squealmap.InputError, match="squealmap"):
        squealmap.plot(xarray.Dataset({"a": ("x", np.zeros(3))}))


def test_a_part_of_a_trace_draws_itself():
    found = squealmap.trace(FIRST, instance=2, samples_per_period=20)
    part = found.isel(t=slice(0, 100))
    assert "<svg" in part.squealmap.plot().svg
