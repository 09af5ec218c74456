"""``python -m squealmap``: the program."""

from ._program import main

main()
