"""Opens what `squealmap export` wrote with xarray, netCDF4, scipy and pandas and compares it with map.csv.

    python3 -m venv /tmp/exports && /tmp/exports/bin/pip install xarray zarr netCDF4 scipy pandas pyarrow
    /tmp/exports/bin/python .ci/exports.py OUTPUT_DIRECTORY
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from scipy.io import netcdf_file

directory = Path(sys.argv[1])
table = pd.read_csv(directory / "map.csv", keep_default_na=False, na_values=[""])
compared = 0


def names(variable):
    """The names of a variable of codes, None where it is undefined."""
    codes = np.atleast_1d(variable.attrs["flag_values"]).tolist()
    meanings = dict(zip(codes, variable.attrs["flag_meanings"].split(" ")))
    return [None if (name := meanings[code]) == "undefined" else name for code in variable.values.ravel().tolist()]


def compare(dataset, what):
    """Every column of the table against the variable or the coordinate of its name."""
    global compared
    for name in table.columns.drop("instance"):
        variable = dataset[name]
        if name in dataset.coords and "status" in dataset:
            variable = variable.broadcast_like(dataset["status"]).transpose(*dataset["status"].dims)
        wanted = table[name]
        if "flag_values" in variable.attrs or "flag_values" in dataset[name].attrs:
            variable.attrs = dataset[name].attrs
            found = pd.Series(names(variable), dtype=object)
            if name == "settled":
                found = found.map({"no": 0, "yes": 1}).astype(float)
                assert np.array_equal(found, wanted.astype(float), equal_nan=True), (what, name)
            else:
                assert (found.fillna("") == wanted.fillna("")).all(), (what, name)
        else:
            assert np.array_equal(variable.values.ravel(), wanted.astype(float), equal_nan=True), (what, name)
            assert dataset[name].attrs["units"] and dataset[name].attrs["long_name"], (what, name)
        compared += 1


zarr = xr.open_zarr(directory / "map.zarr")
compare(zarr, "zarr")
netcdf = xr.open_dataset(directory / "map.nc", engine="netcdf4")
compare(netcdf, "netcdf4")
compare(xr.open_dataset(directory / "map.nc", engine="scipy"), "scipy")
with netcdf_file(directory / "map.nc", mmap=False) as file:
    assert file.variables["status"].data.size == len(table)


def same(frame):
    """Whether a data frame is the table: its columns in order, numbers in every bit, names."""
    if list(frame.columns) != list(table.columns) or len(frame) != len(table):
        return False
    numeric = [name for name in table.columns if pd.api.types.is_numeric_dtype(table[name])]
    others = [name for name in table.columns if name not in numeric and table[name].notna().any()]
    return all(
        np.array_equal(frame[name].astype(float), table[name].astype(float), equal_nan=True) for name in numeric
    ) and all((frame[name].fillna("") == table[name].fillna("")).all() for name in others)


frame = pd.read_parquet(directory / "map.parquet")
assert same(frame), "parquet"
assert all(frame.attrs["meanings"][name] for name in frame.columns) and frame.attrs["units"]["growth_rate"] == "1/s"

# The comparison sees a fault.
for name in ["growth_rate", "status"]:
    spoilt = frame.copy()
    spoilt.loc[3, name] = spoilt.loc[4, name] + spoilt.loc[4, name]
    if same(spoilt):
        sys.exit(f"the planted fault in {name} of the data frame was not seen")
agreed = compared
spoilt = zarr.load().copy(deep=True)
spoilt["status"].values.flat[0] += 1
try:
    compare(spoilt, "planted fault")
except (AssertionError, KeyError):
    print(f"{agreed} columns of {len(table)} instances agree; dimensions {dict(zarr.sizes)}")
else:
    sys.exit("the planted fault was not seen")
