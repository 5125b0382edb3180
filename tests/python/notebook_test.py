"""The notebooks of the lecture run from the first cell to the last, and show what they promise."""

import ast
import contextlib
import io
import json
import os
import unittest
import warnings
from pathlib import Path

from support import FolderTest

NOTEBOOKS = Path("assets/notebooks").resolve()


def shown(value) -> str:
    """As a notebook shows it: the richest form that there is."""
    for form in ("_repr_html_", "_repr_svg_"):
        if hasattr(value, form):
            return getattr(value, form)()
    return repr(value)


def run_cell(source: str, names: dict) -> str:
    """What the cell's last line shows, where that is an expression."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)  # pylint: disable=exec-used
    return "" if last is None else shown(eval(compile(ast.Expression(last.value), "cell", "eval"), names))


class Notebooks(FolderTest):
    def run_notebook(self, name: str) -> list:
        notebook = json.loads((NOTEBOOKS / name).read_text(encoding="utf-8"))
        self.assertEqual(notebook["nbformat"], 4)
        names = {"__name__": "__main__"}
        results = []
        with contextlib.chdir(self.folder), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for cell in notebook["cells"]:
                source = "".join(cell["source"])
                self.assertTrue(source.strip(), cell["id"])
                if cell["cell_type"] != "code":
                    continue
                self.assertFalse(cell["outputs"], "kept without outputs: their films are large")
                try:
                    with contextlib.redirect_stdout(io.StringIO()):
                        results.append(run_cell(source, names))
                except Exception as error:
                    raise AssertionError(f"{name}, cell {cell['id']}: {error!r}\n{source}") from error
        return results

    def test_the_open_chain(self):
        results = self.run_notebook("open_chain.ipynb")
        self.assertEqual(sum("<video" in result for result in results), 3)
        self.assertEqual(sum("</svg>" in result for result in results), 1)
        self.assertTrue(os.path.getsize(self.path("driven.mp4")) > 0)
        self.assertTrue(os.path.getsize(self.path("driven.png")) > 0)

    def test_every_notebook_is_run_here(self):
        self.assertEqual([path.name for path in NOTEBOOKS.glob("*.ipynb")], ["open_chain.ipynb"])


if __name__ == "__main__":
    unittest.main()
