"""Runs notebooks from their first cell to their last; fails on one that raises, or that is stored with outputs.

    python .ci/notebooks.py docs/notebooks/*.ipynb
"""

import sys
import time

import nbclient
import nbformat

for path in sys.argv[1:]:
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    stored = [cell for cell in notebook.cells if cell.cell_type == "code" and (cell.outputs or cell.execution_count)]
    assert not stored, f"{path} is stored with outputs"
    began = time.monotonic()
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": "docs/notebooks"}}).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    figures = sum("image/svg+xml" in output.get("data", {}) for output in outputs)
    assert figures, f"{path} shows no figure"
    print(f"{path}: {figures} figures in {time.monotonic() - began:.1f} s")
