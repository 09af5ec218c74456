"""The program: ``squealmap`` on the command line."""

from __future__ import annotations

import os
import signal
import sys


def main() -> None:
    """Runs the program with the arguments of this process and ends with its exit code."""
    # Ctrl-C is the program's own business.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    from . import _squealmap

    name = sys.argv[0]
    # The file that starts the program again, as jobs of a cluster do.
    program = os.path.abspath(name) if os.path.basename(name).startswith("squealmap") else None
    if sys.stdout is not None:
        sys.stdout.flush()
    sys.exit(_squealmap.main(program, ["squealmap", *sys.argv[1:]]))
