"""Writes the records of this folder: one stroke, by programs other than squealmap.

    pip install numpy==2.* scipy==1.17.1 npTDMS==1.13.0 pyuff==2.5.8
    python make.py
"""

from pathlib import Path

import numpy as np
import pyuff
from nptdms import ChannelObject, GroupObject, RootObject, TdmsWriter
from scipy.io import savemat

RATE = 50_000
COUNT = 600

time = np.arange(COUNT) / RATE
squeal = np.exp(400 * (time - time[-1])) * np.exp(2j * np.pi * 2500 * time)
normal = 17 + (1.5 * squeal * np.exp(-0.4j)).real
noise = np.random.default_rng(58)


def shown(values, size=0.0):
    """No more digits than universal files in single precision have."""
    return np.round(values + size * noise.normal(size=COUNT), 3)


columns = {
    "ax2": shown((30 * squeal).real, 0.01),
    "ay1": shown((20 * squeal * np.exp(-1.2j)).real, 0.01),
    "T": shown(0.4 * normal + (0.2 * squeal * np.exp(0.3j)).real, 0.002),
    "N": shown(normal, 0.002),
    "V": shown(0.1 - 4.0 * time, 0.0),
}

np.savetxt(
    "stroke.csv",
    np.column_stack(list(columns.values())),
    fmt="%.3f",
    delimiter=",",
    header=",".join(columns),
    comments="",
)

others = {"note": "a stroke", "rig": {"load": 17.0}, "fs": float(RATE), "z": 1j * time[:, None]}
savemat("columns_v7.mat", {**{k: v[:, None] for k, v in columns.items()}, **others}, do_compression=True)
savemat("matrix_v6.mat", {"data": np.column_stack([time, *columns.values()]), **others}, do_compression=False)


def universal(name, binary):
    Path(name).unlink(missing_ok=True)
    for place, (channel, values) in enumerate(columns.items()):
        record = pyuff.prepare_58(
            binary=binary,
            func_type=1,
            rsp_node=place + 1,
            rsp_dir=1,
            ref_node=0,
            ref_dir=0,
            data=values,
            x=time,
            id1=channel,
            id2="stroke",
            id3="NONE",
            id4="NONE",
            id5="NONE",
            num_pts=COUNT,
            abscissa_spacing=1,
            abscissa_min=0.0,
            abscissa_inc=1 / RATE,
            ord_data_type=4 if binary else 2,
            abscissa_spec_data_type=17,
            abscissa_axis_units_lab="s",
            orddenom_spec_data_type=0,
        )
        # Not "overwrite": pyuff 2.5.8 loses the first binary record then.
        pyuff.UFF(name).write_sets([record], "add")


universal("ascii_58.uff", 0)
universal("binary_58b.uff", 1)

half = COUNT // 2
waveform = {"wf_increment": 1 / RATE, "wf_start_offset": 0.0, "wf_start_time": np.datetime64("2026-01-01")}
with TdmsWriter("stroke.tdms") as file:
    file.write_segment(
        [RootObject({"author": "a laboratory"}), GroupObject("Rig"), ChannelObject("Rig", "comment", ["begin"])]
        + [ChannelObject("Rig", k, v[:half], waveform) for k, v in columns.items()]
    )
    file.write_segment([ChannelObject("Rig", k, v[half:]) for k, v in columns.items()])
