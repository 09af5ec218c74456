"""A map from Python is that of the program, in every value."""

import json
import subprocess
import sys
import textwrap

import numpy as np
import pytest
import squealmap
import xarray
from conftest import FIRST, FIRST_TOML, ROOT, document, number, table

# Of two runs on one machine.
OF_THE_RUN = ["elapsed_seconds", "instances_per_second"]


def compare(dataset, columns):
    """Every column of `map.csv` against the variable or coordinate of its name; gives how many there were."""
    compared = 0
    for name, cells in columns.items():
        if name == "instance":
            continue
        variable = dataset[name]
        if name in dataset.coords:
            variable = variable.broadcast_like(dataset["status"])
        variable = variable.transpose(*dataset["status"].dims)
        if "flag_values" in dataset[name].attrs:
            names = dataset.squealmap.names(name).values.ravel().tolist()
            said = [{"no": "0", "yes": "1"}.get(one, one) for one in names]
            assert said == cells, name
        elif variable.dtype.kind in "OU":
            assert variable.values.ravel().tolist() == cells, name
        else:
            wanted = np.array([number(cell) for cell in cells])
            assert np.array_equal(variable.values.ravel(), wanted, equal_nan=True), name
            assert dataset[name].attrs["units"] and dataset[name].attrs["long_name"], name
        compared += 1
    return compared


def test_the_map_of_the_program_in_every_value(first):
    dataset = squealmap.run(first / "first.toml")
    assert isinstance(dataset, xarray.Dataset)
    columns = table(first / "out/map.csv")
    assert compare(dataset, columns) == len(columns) - 1 > 25
    assert dict(dataset.sizes) == {"mu_s": 5, "belt_velocity": 7}
    # The comparison turns red on one value.
    columns["x2_std"][17] = "0.1"
    with pytest.raises(AssertionError, match="x2_std"):
        compare(dataset, columns)
    columns = table(first / "out/map.csv")
    columns["regime"][3] = "detaching"
    with pytest.raises(AssertionError, match="regime"):
        compare(dataset, columns)


def test_the_manifest_of_the_program(first):
    made = json.loads(squealmap.run(first / "first.toml").attrs["manifest"])
    wanted = document(first / "out/manifest.json")
    for one in [made, wanted]:
        for key in OF_THE_RUN:
            one["computation"].pop(key)
        for key in ["sweep_id", "tiles", "files", "checksum"]:
            one.pop(key, None)
    assert made == wanted


def test_the_three_lines_of_the_readme(tmp_path, program, monkeypatch):
    """As they stand there: the shipped map, whole, is `map.csv` of the program."""
    said = (ROOT / "README.md").read_text().split("```python\n")[1].split("```")[0]
    assert len(said.splitlines()) == 3 and "sweeps/paper_map.toml" in said, said
    ended = program("run", ROOT / "sweeps/paper_map.toml", "-o", tmp_path)
    assert ended.returncode == 0, ended.stderr
    monkeypatch.chdir(ROOT)
    names = {}
    exec(said, names)
    columns = table(tmp_path / "map.csv")
    assert names["ds"]["status"].size == len(columns["instance"]) == 8405
    assert compare(names["ds"], columns) == len(columns) - 1 > 25


@pytest.mark.parametrize("level", ["draft", "paper", 0.005, "reference"])
def test_accuracy_is_that_of_the_program(level, tmp_path, program):
    (tmp_path / "first.toml").write_text(FIRST_TOML)
    words = ["run", "first.toml", "-o", "out", "--accuracy", level, "--backend", "reference" if level == "reference" else "cpu"]
    ended = program(*words, cwd=tmp_path)
    assert ended.returncode == 0, ended.stderr
    made = squealmap.run(tmp_path / "first.toml", accuracy=level, backend=words[-1])
    compare(made, table(tmp_path / "out/map.csv"))
    wanted = document(tmp_path / "out/manifest.json")["computation"]["accuracy"]
    assert wanted["asked"] and json.loads(made.attrs["manifest"])["computation"]["accuracy"] == wanted


@pytest.mark.parametrize("name", ["bistable_band", "tuples", "temperature_map", "basin", "mass_on_belt", "cycle_map"])
def test_shipped_sweeps(name, tmp_path, program):
    """Two starts, listed instances, materials, boxes of starts, cycles: those of the program."""
    ended = program("run", ROOT / f"sweeps/{name}.toml", "-o", tmp_path)
    assert ended.returncode == 0, ended.stderr
    columns = table(tmp_path / "map.csv")
    assert compare(squealmap.run(ROOT / f"sweeps/{name}.toml"), columns) == len(columns) - 1


def test_a_dict_a_path_and_a_sweep_are_the_same(first):
    sweep = (
        squealmap.Sweep("Friction against belt velocity")
        .friction(law="bilinear", mu_d=0.2)
        .axis("mu_s", start=0.2, stop=0.6, points=5)
        .axis("belt_velocity", start=0.3, stop=6.3, points=7)
        .response(settle="auto")
    )
    made = squealmap.run(first / "first.toml")
    for other in [FIRST, sweep, str(first / "first.toml"), sweep.to_dict()]:
        found = squealmap.run(other)
        assert made.drop_attrs().identical(found.drop_attrs())
    values = {**FIRST, "axes": {"mu_s": np.linspace(0.2, 0.6, 3), "belt_velocity": {"values": (1, 2.0)}}}
    values["axes"]["mu_s"] = {"values": values["axes"]["mu_s"]}
    assert squealmap.run(values)["mu_s"].values.tolist() == np.linspace(0.2, 0.6, 3).tolist()


def test_a_sweep_written_is_the_same_sweep(tmp_path):
    sweep = squealmap.Sweep('"quoted" \\ and\nµ').friction(law="bilinear", mu_s=0.5, mu_d=0.2)
    sweep = sweep.belt(belt_velocity=3.0).axis("theta", [0.0, 1e-5, 0.1])
    with pytest.raises(squealmap.InputError, match="title"):
        squealmap.linear(sweep)
    sweep = squealmap.Sweep('"quoted" \\ and µ', keys=sweep.keys)
    sweep.write(tmp_path / "sweep.toml")
    made = [squealmap.linear(one) for one in [sweep, tmp_path / "sweep.toml"]]
    assert made[0].drop_attrs().identical(made[1].drop_attrs())
    assert made[0].attrs["title"] == '"quoted" \\ and µ'


def test_eigenvalues_alone(first):
    both, alone = squealmap.run(FIRST), squealmap.linear(FIRST)
    assert "regime" not in alone and set(alone.data_vars) < set(both.data_vars)
    for name in alone.data_vars:
        if name != "status":
            assert alone[name].identical(both[name]), name


def test_arrays_own_what_was_computed():
    dataset = squealmap.linear(FIRST)
    values = dataset["growth_rate"].values
    while isinstance(values.base, np.ndarray):
        values = values.base
    # The memory belongs to the compiled part: a copy would own its data.
    assert not values.flags.owndata and type(values.base).__name__ == "PySliceContainer"


def test_netcdf_takes_it(tmp_path):
    dataset = squealmap.run(FIRST)
    dataset.to_netcdf(tmp_path / "map.nc")
    with xarray.open_dataset(tmp_path / "map.nc") as back:
        for name in dataset.data_vars:
            assert np.array_equal(back[name], dataset[name], equal_nan=dataset[name].dtype.kind == "f"), name
        assert back.squealmap.plot().svg == dataset.squealmap.plot().svg


def test_without_xarray(first):
    """Arrays of numpy with the same values, and no import of xarray."""
    text = """
        import sys
        sys.modules["xarray"] = None
        import numpy, squealmap
        made = squealmap.run("first.toml")
        assert type(made) is squealmap.Arrays, made
        assert made["x2_std"].shape == (5, 7) and made.sizes == {"mu_s": 5, "belt_velocity": 7}
        assert made.units["x2_std"] == "m" and made.dims["x2_std"] == ("mu_s", "belt_velocity")
        assert made.manifest["title"].startswith("Friction") and "x2_std" in repr(made)
        assert list(squealmap.open("out")) == list(made) and len(made) > 25
        numpy.savez("arrays.npz", regime=made.names("regime").astype(str), **{name: made[name] for name in made if name != "regime"})
    """
    ended = subprocess.run([sys.executable, "-c", textwrap.dedent(text)], cwd=first, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    dataset = squealmap.run(first / "first.toml")
    found = np.load(first / "arrays.npz")
    for name in dataset.data_vars:
        wanted = dataset.squealmap.names(name).astype(str) if name == "regime" else dataset[name]
        assert np.array_equal(found[name], wanted, equal_nan=found[name].dtype.kind == "f"), name


def test_progress_has_the_interface_of_tqdm():
    told = []

    class Bar:
        def __init__(self, total, unit):
            told.append(("begins", total))

        def update(self, count):
            told.append(("more", count))

        def close(self):
            told.append(("ends", 0))

    squealmap.run(FIRST, progress=Bar)
    assert told[0] == ("begins", 35) and told[-1] == ("ends", 0)
    assert sum(count for what, count in told if what == "more") == 35


def test_what_progress_raises_stops_the_sweep():
    class Wrong(Exception):
        pass

    def bar(**_):
        raise Wrong("no bar")

    with pytest.raises(Wrong, match="no bar"):
        squealmap.run(FIRST, progress=bar)


def test_engines_are_those_of_the_program(tmp_path, program):
    (tmp_path / "first.toml").write_text(FIRST_TOML)
    for options, keys in [
        (["--backend", "cpu", "--precision", "f32"], {"backend": "cpu", "precision": "f32"}),
        (["--backend", "reference"], {"backend": "reference"}),
        (["--no-check", "--threads", "1"], {"check": False, "threads": 1}),
    ]:
        ended = program("run", "first.toml", "-o", "out", "--force", *options, cwd=tmp_path)
        assert ended.returncode == 0, ended.stderr
        made = squealmap.run(tmp_path / "first.toml", **keys)
        compare(made, table(tmp_path / "out/map.csv"))
