"""Studies from Python have the numbers of the files that the program writes."""

import numpy as np
import pytest
import squealmap
from conftest import FIRST, ROOT, document, number, table


def numbers(cells):
    return np.array([number(cell) for cell in cells])


def same(variable, cells):
    return np.array_equal(np.asarray(variable, dtype=float).ravel(), numbers(cells), equal_nan=True)


def test_modes(first, program):
    assert program("modes", "first.toml", "-o", "modes", cwd=first).returncode == 0
    columns = table(first / "modes/modes.csv")
    found = squealmap.modes(first / "first.toml")
    assert dict(found.sizes)["mode"] == 2 and found["frequency"].dims == ("mu_s", "belt_velocity", "mode")
    for mode in [1, 2]:
        for name, column in [
            ("frequency", f"frequency_{mode}"),
            ("growth_rate", f"growth_rate_{mode}"),
            ("growth_rate_fast", f"growth_rate_{mode}_fast"),
        ]:
            assert same(found[name].sel(mode=mode), columns[column]), column
    wanted = document(first / "modes/modes.json")["critical"]
    assert [[one for one in row if one == one] for row in found["critical"].values.tolist()] == wanted
    assert found["frequency"].attrs["units"] == "Hz"


def test_modes_of_a_contact_that_nothing_couples():
    """At theta = 0 and without damping both frequencies are those of a mass on its spring."""
    sweep = {
        "friction": {"law": "constant"},
        "model": {"theta": 0.0, "c1": 0.0, "c2": 0.0},
        "belt": {"belt_velocity": 3.0},
        "axes": {"mu_d": {"values": [0.1, 0.2]}},
    }
    found = squealmap.modes(sweep)
    # Both masses on k1 along the belt, m1 alone on k2 normal to it.
    wanted = sorted([(1e5 / 2.3) ** 0.5 / (2 * np.pi), (101e3 / 2.12) ** 0.5 / (2 * np.pi)])
    assert np.allclose(np.sort(found["frequency"].values, axis=-1), wanted, rtol=1e-12)


def test_trace(first, program):
    assert program("trace", "first.toml", "--at", "mu_s=0.3,belt_velocity=1", "-o", "cell", cwd=first).returncode == 0
    columns = table(first / "cell/trace.csv")
    found = squealmap.trace(first / "first.toml", {"mu_s": 0.3, "belt_velocity": np.float64(1)})
    assert found.squealmap.names("state").values.tolist() == columns.pop("state")
    for name, cells in columns.items():
        assert same(found[name], cells), name
        assert found[name].attrs["units"] and found[name].attrs["long_name"], name
    again = squealmap.trace(FIRST, instance=8)
    assert again.attrs["at"] == "mu_s=0.3,belt_velocity=1.3" and again.attrs["status"] == "ok"
    # A velocity is the slope of its displacement where nothing happens: both from the same rows.
    smooth = slice(0, 20)
    slope = np.gradient(again["x2"].values[smooth], again["t"].values[smooth])
    assert np.allclose(slope[1:-1], again["vx2"].values[smooth][1:-1], rtol=0.02, atol=1e-4)


@pytest.fixture(scope="module")
def stroke(tmp_path_factory, program):
    """Signals of a contact that squeals, as sensors would record it."""
    directory = tmp_path_factory.mktemp("stroke")
    ended = program("trace", ROOT / "sweeps/trace.toml", "--rate", "20000", "-o", directory)
    assert ended.returncode == 0, ended.stderr
    return directory


def test_identify(stroke, program):
    assert program("identify", "signals.csv", "-o", "found", cwd=stroke).returncode == 0
    found = squealmap.identify(stroke / "signals.csv")
    wanted = document(stroke / "found/identify.json")
    made = dict(found.report)
    assert made.pop("signals").endswith(wanted.pop("signals"))
    assert made == wanted and found.summary == wanted["summary"]
    for name, cells in table(stroke / "found/windows.csv").items():
        if name in found.windows.data_vars and found.windows[name].dtype.kind == "f":
            assert same(found.windows[name], cells), name
        else:
            assert found.windows[name].values.tolist() == cells, name
    import xarray

    with xarray.open_dataset(stroke / "found/spectrogram.nc") as spectrogram:
        for name in ["time", "frequency", "normalised", "decibel"]:
            assert np.array_equal(found.spectrogram[name], spectrogram[name]), name
    assert found.figure.svg == (stroke / "found/identify.svg").read_text()
    assert "<svg" in found._repr_svg_() and found.summary in repr(found)


def test_identify_with_a_model(stroke, program, tmp_path):
    model = ROOT / "sweeps/trace.toml"
    assert program("identify", "signals.csv", "--model", model, "-o", tmp_path, cwd=stroke).returncode == 0
    found = squealmap.identify(stroke / "signals.csv", model=model)
    assert found.report["segments"] == document(tmp_path / "identify.json")["segments"]
    assert any("model" in note for note in found.report["notes"])
    with pytest.raises(squealmap.InputError, match="none.toml"):
        squealmap.identify(stroke / "signals.csv", model="none.toml")
    with pytest.raises(squealmap.InputError, match="force_skew is given beside model"):
        squealmap.identify(stroke / "signals.csv", model=model, force_skew=1e-6)


def test_identify_with_other_columns(stroke, tmp_path):
    text = (stroke / "signals.csv").read_text().replace("ax2", "tangential", 1)
    (tmp_path / "signals.csv").write_text(text)
    found = squealmap.identify(tmp_path / "signals.csv", tangential_acceleration="tangential", band=(1, 100))
    assert found.report["columns"]["tangential_acceleration"] == "tangential"
    for keys, words in [
        ({"band": (3, 1)}, "band is"),
        ({"overlap": 1.0}, "overlap is 1 but"),
        ({"rate": -1.0}, "rate is -1 but"),
        ({"time_unit": "year"}, "time_unit is"),
        ({"window": float("nan")}, "window is"),
        ({"critical_friction": 0.0}, "critical_friction"),
        ({"normal_force": "none"}, "none"),
    ]:
        with pytest.raises(squealmap.InputError, match=words):
            squealmap.identify(stroke / "signals.csv", **keys)


def test_fit(tmp_path, program):
    law = {100.0: (0.5, 0.35), 300.0: (0.4, 0.2)}
    rows = [
        f"{v},{temperature},{s + (d - s) * min(v / 4, 1)}"
        for temperature, (s, d) in law.items()
        for v in np.linspace(0.1, 6, 12)
    ]
    (tmp_path / "points.csv").write_text("V,temperature,mu\n" + "\n".join(rows) + "\n")
    words = ["fit", "points.csv", "--friction", "mu", "--law-velocity", "4", "-o", "out"]
    assert program(*words, cwd=tmp_path).returncode == 0
    found = squealmap.fit(tmp_path / "points.csv", friction="mu", law_velocity=4)
    # The law that the points were made from.
    assert found.material["temperature"].values.tolist() == list(law)
    for at, (s, d) in enumerate(law.values()):
        assert np.isclose(found.material["mu_s"][at], s, atol=1e-9) and np.isclose(found.material["mu_d"][at], d, atol=1e-9)
    for name, cells in table(tmp_path / "out/residuals.csv").items():
        assert same(found.residuals[name], cells), name
    found.write(tmp_path / "material.csv")
    assert table(tmp_path / "material.csv") == table(tmp_path / "out/material.csv")
    sweep = {
        "friction": {"law": "bilinear", "material": tmp_path / "material.csv"},
        "axes": {"temperature": {"from": 100, "to": 300, "points": 3}, "belt_velocity": {"values": [1.0]}},
    }
    assert squealmap.linear(sweep)["type"].shape == (3, 1)


def test_fit_of_several_files(tmp_path, program):
    law = {100.0: (0.5, 0.35), 300.0: (0.4, 0.2)}
    for at, (s, d) in law.items():
        # There and back: friction opposes the sliding.
        rows = [f"{v},{10 * np.sign(v) * (s + (d - s) * min(abs(v) / 4, 1))},10" for v in np.linspace(-6, 6, 24)]
        (tmp_path / f"{at:.0f}.csv").write_text("V,T,N\n" + "\n".join(rows) + "\n")
    files = [tmp_path / "100.csv", tmp_path / "300.csv"]
    found = squealmap.fit(files, at_temperature=list(law), law_velocity=4)
    assert found.material["temperature"].values.tolist() == list(law)
    for at, (s, d) in enumerate(law.values()):
        assert np.isclose(found.material["mu_s"][at], s, atol=1e-9) and np.isclose(found.material["mu_d"][at], d, atol=1e-9)
    ended = program("fit", "100.csv", "300.csv", "--at-temperature", "100,300", "--law-velocity", "4", cwd=tmp_path)
    assert ended.returncode == 0
    written = table(tmp_path / "out/100/material.csv")["mu_s"]
    assert [float(value) for value in written] == found.material["mu_s"].values.tolist()
    with pytest.raises(squealmap.InputError, match="3 temperatures are given for 2 file"):
        squealmap.fit(files, at_temperature=[1, 2, 3])
    with pytest.raises(TypeError, match="not an empty list"):
        squealmap.fit([])


@pytest.mark.parametrize("law", ["table", "best"])
def test_fit_of_a_table_and_of_the_best_law(tmp_path, program, law):
    rows = [
        f"{v},{temperature},{0.3 + 1e-4 * temperature - 0.1 * min(v / 3, 1) + 0.002 * np.sin(11 * k):.6f}"
        for temperature in (100.0, 300.0)
        for k, v in enumerate(np.linspace(0.1, 6, 60))
    ]
    (tmp_path / "points.csv").write_text("V,temperature,mu\n" + "\n".join(rows) + "\n")
    ended = program("fit", "points.csv", "--friction", "mu", "--law", law, "-o", "out", cwd=tmp_path)
    assert ended.returncode == 0, ended.stderr
    found = squealmap.fit(tmp_path / "points.csv", friction="mu", law=law)
    found.write(tmp_path / "material.csv")
    assert table(tmp_path / "material.csv") == table(tmp_path / "out/material.csv")
    assert found.comparison in ended.stdout and 'law "bilinear"' in found.comparison
    if law == "best":
        # The points fall to a knee at 3 m/s.
        assert found.material.attrs["law"] == "bilinear"
        assert np.allclose(found.material["knee_velocity"], 3, rtol=0.05)
        return
    assert set(found.material["temperature"].values) == {100.0, 300.0}
    at = np.abs(found.material["velocity"].values - 1.5).argmin()
    level = 0.3 + 1e-4 * found.material["temperature"][at] - 0.1 * found.material["velocity"][at] / 3
    assert np.isclose(found.material["mu"][at], level, atol=0.003)
    sweep = {
        "friction": {"law": "table", "material": tmp_path / "material.csv", "temperature": 200},
        "axes": {"belt_velocity": {"values": [1.0, 5.0]}},
    }
    assert squealmap.linear(sweep)["type"].shape == (2,)


def test_fem(tmp_path, program):
    study = ROOT / "crates/fem/tests/suite/study/pin.toml"
    assert program("fem", study, "-o", tmp_path).returncode == 0
    columns = table(tmp_path / "fem.csv")
    found = squealmap.fem(study)
    like = found["frequency"]
    for name, cells in columns.items():
        assert same(found[name].broadcast_like(like).transpose("mu", "mode"), cells), name
    assert found["frequency"].attrs["units"] == "Hz"
    drawn = found.squealmap.plot().svg
    assert pictures(drawn) == pictures((tmp_path / "fem.svg").read_text())
    assert pictures(found.transpose().sortby("mu", ascending=False).squealmap.plot().svg) == pictures(drawn)
    with pytest.raises(squealmap.InputError, match="two values are needed"):
        found.isel(mu=0).squealmap.plot()


def pictures(svg):
    """A figure without what it says of how it was made."""
    return svg[svg.index("</metadata>") :] if "</metadata>" in svg else svg
