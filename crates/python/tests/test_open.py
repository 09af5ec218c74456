"""A directory of tiles, read as values are asked for."""

import numpy as np
import pytest
import squealmap
from conftest import table
from test_map import compare


@pytest.fixture(scope="module")
def tiled(tmp_path_factory, program):
    """A map in many tiles."""
    directory = tmp_path_factory.mktemp("tiled")
    (directory / "map.toml").write_text("""
        analysis = ["linear"]
        friction.law = "bilinear"
        axes.mu_s = { from = 0.0, to = 0.6, points = 7 }
        axes.mu_d = { from = 0.0, to = 0.6, points = 11 }
        axes.belt_velocity = { values = [1, 3, 6] }
    """)
    ended = program("run", "map.toml", "-o", "out", "--tile", "16", cwd=directory)
    assert ended.returncode == 0, ended.stderr
    return directory


@pytest.mark.parametrize("chunks", ["tiles", None])
def test_the_same_values(tiled, chunks):
    opened = squealmap.open(tiled / "out", chunks=chunks)
    assert compare(opened, table(tiled / "out/map.csv")) > 5
    assert opened.squealmap.manifest["complete"] is True
    assert opened.drop_attrs().load().identical(squealmap.run(tiled / "map.toml").drop_attrs())


def test_dask_where_it_is_installed(tiled):
    dask = pytest.importorskip("dask.array")
    opened = squealmap.open(tiled / "out")
    growth = opened["growth_rate"]
    assert isinstance(growth.data, dask.Array) and growth.data.npartitions > 5
    assert float(growth.max()) == float(squealmap.run(tiled / "map.toml")["growth_rate"].max())


def test_parts_are_read_alone(tiled):
    whole = squealmap.run(tiled / "map.toml")
    opened = squealmap.open(tiled / "out", chunks=None)
    for part in [
        {"mu_s": 3},
        {"mu_s": 3, "mu_d": 2},
        {"mu_s": 3, "mu_d": 2, "belt_velocity": 1},
        {"mu_s": slice(1, 6, 2), "mu_d": slice(None, None, -1)},
        {"mu_s": slice(5, 1, -2), "belt_velocity": -1},
        {"belt_velocity": [2, 0]},
        {"mu_s": slice(3, 3)},
    ]:
        for name in ["growth_rate", "type"]:
            assert np.array_equal(opened[name].isel(part), whole[name].isel(part), equal_nan=name != "type"), part


def test_a_damaged_tile_is_told_when_it_is_read(tiled, tmp_path):
    import shutil

    shutil.copytree(tiled / "out", tmp_path / "out")
    tile = sorted((tmp_path / "out/tiles").glob("00000004-*"))[0]
    content = bytearray(tile.read_bytes())
    content[200] ^= 1
    tile.write_bytes(content)
    opened = squealmap.open(tmp_path / "out", chunks=None)
    opened["growth_rate"].isel(mu_s=0).load()
    with pytest.raises(squealmap.InputError, match="00000004.* is bad"):
        opened["growth_rate"].load()
    # One that is not there is not computed.
    tile.unlink()
    status = squealmap.open(tmp_path / "out")["status"]
    names = squealmap.names(status).values.ravel().tolist()
    assert names.count("not_computed") == 16


def test_a_directory_without_results(tiled, tmp_path):
    import shutil

    shutil.copytree(tiled / "out", tmp_path / "out")
    (tmp_path / "out/manifest.json").unlink()
    opened = squealmap.open(tmp_path / "out")
    assert opened.squealmap.manifest["spec"] and "<svg" in opened.squealmap.plot().svg
    with pytest.raises(squealmap.InputError):
        squealmap.open(tmp_path)
    with pytest.raises(ValueError, match="chunks"):
        squealmap.open(tiled / "out", chunks="auto")
