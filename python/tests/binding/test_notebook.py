# SPDX-License-Identifier: Apache-2.0
"""The notebooks of python/examples run without an error, and end with a chart."""

from pathlib import Path

import pytest

NOTEBOOKS = sorted(Path(__file__).parents[2].joinpath("examples").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_runs(path):
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=120).execute()
    kept = nbformat.read(path, as_version=4)
    for shown, cell in zip(kept.cells, notebook.cells, strict=True):
        assert bool(shown.get("outputs")) == bool(cell.get("outputs"))
    (output,) = notebook.cells[-1].outputs
    assert "image/png" in output.data
