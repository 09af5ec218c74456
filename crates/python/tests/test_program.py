"""The console script is the program."""

import os
import signal
import subprocess
import sys
import time

import pytest
import squealmap
from conftest import FIRST_TOML, LONG

# The program as cargo builds it, where this is run beside it.
BUILT = os.environ.get("SQUEALMAP_PROGRAM")


def test_version_help_and_codes(program):
    assert program("--version").stdout.strip() == f"squealmap {squealmap.__version__}"
    assert "Usage: squealmap" in program("--help").stdout
    assert program("run").returncode == 2 and "Usage: squealmap run" in program("run").stderr
    assert program("run", "none.toml").returncode == 2
    module = subprocess.run([sys.executable, "-m", "squealmap", "--version"], capture_output=True, text=True)
    assert module.stdout == program("--version").stdout


@pytest.mark.skipif(not BUILT, reason="SQUEALMAP_PROGRAM does not name the program that cargo has built")
def test_it_says_and_writes_what_the_program_does(tmp_path, program):
    (tmp_path / "first.toml").write_text(FIRST_TOML)
    for words in [
        ["keys", "mu_s"],
        ["keys", "--markdown"],
        ["completions", "bash"],
        ["--help"],
        ["check", "none.toml"],
        ["run", "first.toml", "--backend", "tpu"],
        ["adapters", "--json"],
    ]:
        built = subprocess.run([BUILT, *words], cwd=tmp_path, capture_output=True, text=True)
        ours = program(*words, cwd=tmp_path)
        assert (built.stdout, built.stderr, built.returncode) == (ours.stdout, ours.stderr, ours.returncode), words
    assert program("run", "first.toml", "-o", "ours", cwd=tmp_path).returncode == 0
    assert subprocess.run([BUILT, "run", "first.toml", "-o", "built"], cwd=tmp_path, capture_output=True).returncode == 0
    for name in ["map.csv", "map.svg", "map.png"]:
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / "built" / name).read_bytes(), name


def test_the_page_of_explore(tmp_path, program):
    """In the wheel where it was there when the wheel was built; else one sentence says what to do."""
    (tmp_path / "first.toml").write_text(FIRST_TOML)
    ended = program("explore", "first.toml", "-o", "page", cwd=tmp_path)
    if ended.returncode == 0:
        page = (tmp_path / "page/explore.html").read_text()
        assert len(page) > 500_000 and "Friction against belt velocity" in page
    else:
        assert ended.returncode == 2 and "built without the page" in ended.stderr and "crates/explorer/build" in ended.stderr
        assert not (tmp_path / "page").exists()


def test_jobs_of_a_cluster_start_the_console_script(tmp_path, program):
    (tmp_path / "first.toml").write_text(FIRST_TOML)
    said = program("submit", "first.toml", "--slurm", "--dry-run", cwd=tmp_path).stdout
    assert os.path.abspath(program.path) in said, said


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_ctrl_c_is_that_of_the_program(tmp_path, program):
    squealmap.Sweep(keys=LONG).write(tmp_path / "long.toml")
    words = [program.path, "run", "long.toml", "--backend", "cpu"]
    ended = subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    time.sleep(2.0)
    ended.send_signal(signal.SIGINT)
    _, errors = ended.communicate(timeout=60)
    assert ended.returncode == 130, errors
    assert "Traceback" not in errors


def test_it_starts_without_numpy():
    text = "import sys, squealmap._program, squealmap._squealmap; print('numpy' in sys.modules)"
    ended = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True)
    assert ended.stdout.strip() == "False", ended.stderr
