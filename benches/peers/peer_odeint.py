"""Builds odeint.cpp in a temporary folder and runs it on rows."""
import os, subprocess, tempfile
import numpy as np
import model as m

CONSTANTS = (m.m1s, m.s, m.c, m.k1s, m.k2s, m.c1s, m.c2s, m.Fs, m.vks, m.a00, m.i00, m.i01, m.i11, m.V0, m.L0)


class Engine:
    def __init__(self):
        self.program = os.path.join(tempfile.mkdtemp(), "odeint")
        source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "odeint.cpp")
        subprocess.check_call(["c++", "-std=c++17", "-O3", "-march=native", source, "-o", self.program])

    def run(self, rows, tolerance, settle=100, measure=40, per=24):
        """std x2 (m) of the samples of the window, and rows per CPU-second"""
        numbers = "\n".join(" ".join("%r" % float(x) for x in row) for row in [CONSTANTS, *rows])
        done = subprocess.run([self.program, *map(str, (tolerance, settle, measure, per))], input=numbers, check=True, capture_output=True, text=True)
        *std, seconds = map(float, done.stdout.split())
        assert len(std) == len(rows)
        return np.array(std), len(rows)/seconds
