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


def test_the_order_of_dimensions_changes_no_figure():
    """Rows of a figure go through the axes as the sweep names them; the values keep their places."""
    import xarray

    dataset = squealmap.linear({**FIRST, "axes": {**FIRST["axes"], "theta": {"values": [-0.05, 0.01]}}})
    wanted = pictures(dataset.squealmap.plot("growth").svg)
    stacked = dataset.stack(all=("theta", "belt_velocity", "mu_s")).unstack("all")
    joined = xarray.concat([dataset.isel(theta=[at]) for at in range(2)], "theta", data_vars="minimal")
    for other in [dataset.transpose(), dataset.transpose("theta", "mu_s", "belt_velocity"), stacked, joined]:
        assert pictures(other.squealmap.plot("growth").svg) == wanted
    falling = dataset.sortby("mu_s", ascending=False)
    assert pictures(falling.transpose().squealmap.plot("growth").svg) == pictures(falling.squealmap.plot("growth").svg)


def test_modes_are_drawn_in_any_order_and_in_parts():
    sweep = {
        "friction": {"law": "constant"},
        "belt": {"belt_velocity": 3.0},
        "axes": {"mu_d": {"from": 0.0, "to": 0.4, "points": 11}, "theta": {"values": [0.0, 0.01, 0.05]}},
    }
    found = squealmap.modes(sweep)
    wanted = pictures(found.squealmap.plot().svg)
    for other in [found.transpose("theta", "mode", "mu_d", "crossing"), found.sortby("mu_d", ascending=False)]:
        assert pictures(other.squealmap.plot().svg) == wanted

    def swept(**axes):
        return squealmap.modes({**sweep, "axes": {**sweep["axes"], **axes}}).squealmap.plot().svg

    one = pictures(swept(theta={"values": [0.05]}))
    assert pictures(found.isel(theta=[2]).squealmap.plot().svg) == one
    assert pictures(found.sel(theta=0.05).squealmap.plot().svg) == one
    turned = pictures(swept(theta={"values": [0.05, 0.01, 0.0]}))
    assert pictures(found.isel(theta=[2, 1, 0]).squealmap.plot().svg) == turned
    single = pictures(found.isel(theta=[1]).squealmap.plot().svg)
    for other in [found.isel(theta=1, crossing=0), found.isel(theta=[1]).squeeze(), found.isel(theta=[1]).squeeze(drop=True)]:
        if "theta" in other.coords:
            assert pictures(other.squealmap.plot().svg) == single
        else:
            with pytest.raises(squealmap.InputError, match="the values of `theta`"):
                other.squealmap.plot()
    none = squealmap.modes({**sweep, "axes": {"mu_d": {"from": 0.0, "to": 0.1, "points": 4}}})
    assert "<svg" in none.squealmap.plot().svg and "<svg" in none.drop_vars("critical").squealmap.plot().svg
    # Below all crossings, of a sweep without any too.
    below = pictures(swept(mu_d={"from": 0.0, "to": 0.12, "points": 4}))
    assert pictures(found.isel(mu_d=slice(0, 4)).squealmap.plot().svg) == below


def test_what_cannot_be_drawn_is_said_without_files():
    modes = squealmap.modes(FIRST)
    found = squealmap.linear(FIRST)
    trace = squealmap.trace(FIRST, instance=2)
    cases = [
        (modes.isel(mode=0), "with their dimension `mode`"),
        (modes.isel(mode=[1, 0]), "in their order"),
        (modes.rename(mu_s="q"), "the dimensions are q"),
        (modes.drop_vars("mu_s"), "the values of `mu_s` are not there"),
        (trace.drop_vars("t"), "the values of `t` are not there"),
        (modes.isel(mu_s=0, belt_velocity=[0]), "one value is left"),
        (found.stack(both=("mu_s", "belt_velocity")), "the dimensions are both"),
        (found.rename(mu_s="q"), "the dimensions are q"),
        (found.drop_vars("mu_s"), "the values of `mu_s` are not there"),
        (trace[["x2"]], "its `state`"),
    ]
    for part, words in cases:
        with pytest.raises(squealmap.InputError, match=re.escape(words)):
            squealmap.plot(part)
    with pytest.raises(squealmap.InputError, match="name it as quantity"):
        squealmap.plot(found["growth_rate"])


def test_a_sweep_takes_coordinates_of_a_dataset():
    found = squealmap.linear(FIRST)
    again = {**FIRST, "axes": {**FIRST["axes"], "mu_s": {"values": found["mu_s"]}}}
    assert np.array_equal(squealmap.linear(again)["growth_rate"], found["growth_rate"], equal_nan=True)
    assert "<svg" in found.squealmap.plot("growth", cut={"belt_velocity": found["belt_velocity"][1]}).svg
