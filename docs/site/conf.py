"""The site: the pages of the repository where they are, the C header and the Python package, with one search.

`make site` runs Sphinx over the repository with this file. Pages stay Markdown that a code host shows; what only the
site needs, its tree of pages and links that lead into it, is added here while they are read.
"""

import os
import re
import sys
import tomllib
from pathlib import Path

import numpy.typing
from docutils import nodes
from latex2mathml.converter import convert
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util import logging
from sphinx.writers.html5 import HTML5Translator

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(Path(__file__).parent), str(ROOT / "python")]
# The package is imported for its docstrings alone: cffi is replaced by a dummy that never looks at this name.
os.environ["CAGEDYN_LIBRARY"] = "none"

project = "cagedyn"
author = "the authors of cagedyn"
version = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["package"]["version"]
html_title = f"cagedyn {version}"

extensions = ["myst_parser", "sphinx.ext.autodoc", "header"]
html_math_renderer = "mathml"
root_doc = "README"
include_patterns = ["*.md", "docs/*.md", "docs/**/*.md", "python/README.md"]
exclude_patterns = ["out", "target", ".*"]
templates_path = ["."]
html_theme = "furo"
html_additional_pages = {"index": "index.html"}
html_copy_source = False
smartquotes = False
pygments_style = "friendly"

myst_enable_extensions = ["dollarmath"]
myst_fence_as_directive = ["math"]
myst_heading_anchors = 6

# Docstrings have names between single backticks.
default_role = "literal"
autodoc_mock_imports = ["cffi", "cloudpickle", "dask", "distributed", "pandas", "pyarrow", "xarray"]
autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
# Arrays are shown as ndarray[float64] and the like.
numpy.typing.NDArray = numpy.ndarray
autodoc_type_aliases = {"ArrayLike": "ArrayLike"}
nitpicky = True
# What others define; their sites are not fetched.
nitpick_ignore_regex = [("py:.*", r"(numpy|collections|os|pa|xr)\..*|ArrayLike|Path|Scene|Value|Client"), ("c:identifier", r"int(32|64)_t")]

#: Titles of the parts of the tree with their pages.
TREE = {
    "Use": ["docs/gallery", "docs/scene", "docs/scene/*", "docs/outputs"],
    "Hosts": [
        "docs/hosts",
        "docs/fmi",
        "python/README",
        "docs/studies",
        "docs/studies-cli",
        "docs/reference/*",
        "docs/abi",
    ],
    "Model": ["docs/model", "docs/guide", "docs/model/*"],
    "Results": ["docs/papers", "docs/results/*"],
    "Development": [
        "ARCHITECTURE",
        "CONTRIBUTING",
        "docs/building",
        "docs/dependencies",
        "docs/design-space",
        "CHANGELOG",
    ],
}


def for_the_site(app: Sphinx, page: str, source: list[str]) -> None:
    """Adds the tree of pages to the first one, and lets links to the header lead to its reference."""
    if page == root_doc:
        for title, pages in TREE.items():
            options = [":hidden:", ":titlesonly:", ":glob:", f":caption: {title}"]
            source[0] += "\n".join(["", "", "```{toctree}", *options, "", *pages, "```"])
    elif page != "docs/reference/c":
        source[0] = re.sub(r"\]\([./]*include/cagedyn\.h\)", "](/docs/reference/c.md)", source[0])


def public_name(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, content: nodes.TextElement
) -> nodes.reference | None:
    """Leads from a type in a signature, which names the file that defines it, to the public name of that type."""
    name = re.sub(r"^cagedyn\._\w+\.", "cagedyn.", node.get("reftarget", ""))
    if node.get("refdomain") != "py" or name == node["reftarget"]:
        return None
    python = env.domains["py"]
    return python.resolve_xref(env, node["refdoc"], app.builder, node["reftype"], name, node, content)


def mathml(page: HTML5Translator, node: nodes.math | nodes.math_block) -> None:
    """Writes a formula as browsers show it by themselves, without scripts of other sites."""
    formula = convert(node.astext(), display="block" if isinstance(node, nodes.math_block) else "inline")
    if "\\" in formula:
        logging.getLogger(__name__).warning("latex2mathml does not know all of: %s", node.astext(), location=node)
    page.body.append(formula)
    raise nodes.SkipNode


def setup(app: Sphinx) -> None:
    app.connect("source-read", for_the_site)
    app.connect("missing-reference", public_name)
    app.add_html_math_renderer("mathml", (mathml, None), (mathml, None))
