"""The notebooks: every cell runs in a kernel of Jupyter, and files are stored without what a run leaves in them.

CAGEDYN_BLESS=1 python -m pytest python/notebooks -k stored

takes outputs, counts and metadata out of notebooks that Jupyter has saved.
"""

import os
import re
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

FOLDER = Path(__file__).parent
#: Number of pictures that each notebook draws, and what it prints for its text to be true.
SHOWN = {
    "first_run.ipynb": (3, ["trusted: True", "trusted: False", "cage.mas: unknown field `mas`"]),
    "rotor.ipynb": (2, ["trusted: [True, True]"]),
    "study.ipynb": (2, ["stopped;", "12 of 12 points are done", "trusted: 12 of 12"]),
}
#: All metadata that notebooks have.
METADATA = {"kernelspec": {"display_name": "Python 3", "name": "python3"}}
#: s, of one cell.
PATIENCE = 120


def stored(text):
    """A notebook as it is kept: without outputs, counts and metadata of cells."""
    notebook = nbformat.reads(text, as_version=4)
    nbformat.validate(notebook)
    notebook.metadata = METADATA
    for cell in notebook.cells:
        cell.metadata = {}
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    return nbformat.writes(notebook) + "\n"


def printed(outputs):
    """What cells print or show as text."""
    for output in outputs:
        yield output.text if output.output_type == "stream" else output.data.get("text/plain", "")


def test_all_are_known():
    assert {path.name for path in FOLDER.glob("*.ipynb")} == set(SHOWN)


@pytest.mark.parametrize("name", SHOWN)
def test_stored_without_outputs(name):
    path = FOLDER / name
    text = path.read_text(encoding="utf-8")
    kept = stored(text)
    if os.environ.get("CAGEDYN_BLESS"):
        path.write_text(kept, encoding="utf-8")
    else:
        assert text == kept, f"{path} has outputs, counts or metadata; the head of {__file__} has what takes them out"


@pytest.mark.parametrize("name", SHOWN)
def test_links(name):
    notebook = nbformat.read(FOLDER / name, as_version=4)
    texts = [cell.source for cell in notebook.cells if cell.cell_type == "markdown"]
    links = [link for text in texts for link in re.findall(r"\]\(([^)]+)\)", text) if "://" not in link]
    assert [link for link in links if not (FOLDER / link).exists()] == []


@pytest.mark.parametrize("name", SHOWN)
def test_every_cell_runs(name, tmp_path, monkeypatch):
    """In a kernel of this Python, whatever the user has set for others, and with its files in a folder of the test."""
    for variable in ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "TMPDIR"):
        monkeypatch.setenv(variable, str(tmp_path))
    # Jupyter then draws into the notebook.
    monkeypatch.delenv("MPLBACKEND", raising=False)
    notebook = nbformat.read(FOLDER / name, as_version=4)
    where = {"metadata": {"path": str(FOLDER)}}
    NotebookClient(notebook, timeout=PATIENCE, kernel_name="python3", resources=where).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    pictures, texts = SHOWN[name]
    assert sum("image/png" in output.get("data", {}) for output in outputs) == pictures
    text = "\n".join(printed(outputs))
    assert [wanted for wanted in texts if wanted not in text] == []
