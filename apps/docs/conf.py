"""Sphinx's settings for the documentation site. build_docs.py copies this folder, adds the reference and calls Sphinx."""
import os

project = "Ashlar"
author = "The Ashlar developers"
copyright = author  # noqa: A001  Sphinx's name
release = os.environ["ASHLAR_VERSION"]
version = release

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
root_doc = "index"
exclude_patterns = ["CMakeLists.txt"]
html_theme = "furo"
html_title = f"Ashlar {release}"
html_show_copyright = False

myst_heading_anchors = 3
breathe_projects = {"ashlar": os.environ["ASHLAR_DOXYGEN_XML"]}
breathe_default_project = "ashlar"
breathe_default_members = ("members", "undoc-members")
autodoc_member_order = "bysource"
autodoc_typehints = "none"
