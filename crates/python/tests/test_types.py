"""Types: those of the package hold, and the stubs are those of the compiled part."""

import subprocess
import sys

import pytest
import squealmap


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """Checks with what was learned of numpy and xarray before."""
    pytest.importorskip("mypy")
    cache = tmp_path_factory.mktemp("mypy")

    def check(*arguments, cwd):
        words = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(cache), *arguments]
        return subprocess.run(words, capture_output=True, text=True, cwd=cwd)

    return check


def test_types_hold(tmp_path, mypy):
    ended = mypy("-p", "squealmap", cwd=tmp_path)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_types_of_users(tmp_path, mypy):
    """A user with a type checker is told of what is wrong, and of nothing else."""
    (tmp_path / "right.py").write_text(
        "import squealmap\nmade = squealmap.run({'axes': {}}, threads=2)\nsquealmap.Sweep('a').axis('mu_s', [1.0]).write('b')\n"
        "found: str = squealmap.identify('a.csv').summary\n"
    )
    (tmp_path / "wrong.py").write_text("import squealmap\nsquealmap.run(5)\nsquealmap.trace('a', at=3)\nsquealmap.fem()\n")
    said = mypy("right.py", "wrong.py", cwd=tmp_path).stdout
    wrong = [line.split(":")[:2] for line in said.splitlines() if ": error:" in line]
    assert wrong == [["wrong.py", "2"], ["wrong.py", "3"], ["wrong.py", "4"]], said


def test_stubs_are_those_of_the_compiled_part(tmp_path):
    pytest.importorskip("mypy")
    words = [sys.executable, "-m", "mypy.stubtest", "squealmap._squealmap", "--ignore-missing-stub"]
    ended = subprocess.run(words, capture_output=True, text=True, cwd=tmp_path)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_everything_public_is_described():
    """Every public name has a docstring; functions that compute say units or what they raise."""
    for name in squealmap.__all__:
        if name == "__version__":
            continue
        said = getattr(squealmap, name).__doc__
        assert said and said.strip().endswith((".", ":")) or "Raises" in said, name
