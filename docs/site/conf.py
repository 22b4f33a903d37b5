"""Sphinx's configuration of the documentation site; scripts/docs runs it on what stage.py has made."""

import pathlib
import re
import sys

from docutils import nodes

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here))
import docstrings  # noqa: E402
import markdown  # noqa: E402
import theme  # noqa: E402

root = here.parent.parent
project = "Fathom"
version = release = re.search(r"project\(\s*\w+\s+VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())[1]
project_copyright = "the authors of Fathom, GPL-3.0-or-later"
root_doc = "index"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
exclude_patterns = ["files/**"]

html_theme = "furo"
html_title = f"Fathom {version}"
pygments_style, pygments_dark_style = "default", "github-dark"  # their colours have a contrast of 4.5 and more
html_static_path = [str(here / "static")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
html_show_search_summary = False  # a page that is opened from a folder cannot read others
html_last_updated_fmt = None

# As GitHub does it: every heading has an anchor, code without a language is text, addresses stay what they are.
myst_heading_anchors = 6
myst_heading_slug_func = markdown.slug
myst_enable_extensions = ["deflist"]
highlight_language = "text"
smartquotes = False
# Examples of JSON have … and comments where a lexer expects none.
suppress_warnings = ["misc.highlighting_failure", "myst.header"]

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
add_module_names = False
python_use_unqualified_type_names = True
nitpicky = True
# Types of other projects, whose pages are not here, and names of types that the module keeps to itself.
nitpick_ignore_regex = [
    ("py:class", r"(np|npt|numpy|_core|_doctor|os|pathlib|fractions|pytest|collections|typing)\..*"),
    ("py:class", r"((_files\.)?Path|Size|LensKeywords|Unpack|Rows|Ring|Number|Numbers|Cull|Normals|Up|Projection|Background|Mapping|"
                 r"Sequence|Iterable|Fraction|Any|Callable|Literal|optional|Union|Iterator|Answer|Arithmetic|Ties|Edges|Option|Precision|"
                 r"RayChannels|RayMode|RaysLike|EdgeRule|(sight\.)?SurfacePoints|Channels?|ColorMap|ColorScale|Compression|"
                 r"DeepCompression|AreaCentroid|AreaItem|EdgeSelection|Depths|"
                 r"Engine|Frame|Measure|Mesh|Metrics|Model|NormalAxes|Storage)"),
    ("py:class", r"fathom\.(\w+\.)?_\w+(\..*)?"),
    ("c:identifier", r"u?int\d+_t|size_t"),
]

SHORT = 24  # characters of code that a line on a telephone holds easily; half as many in a cell
INLINED = re.compile(r"(?:^|/)images/(?:conventions|lenses)-[\w-]+\.svg$")
ANCHOR = re.compile(r'^<a id="([^"]+)">$')


def anchors_of_raw_html(app, document):
    """<a id="x"></a> of a page can be linked to, as headings can."""
    labels = app.env.get_domain("std").anonlabels
    for raw in list(document.findall(nodes.raw)):
        if found := ANCHOR.match(raw.astext()):
            labels[f"{app.env.docname}.md#{found[1]}"] = app.env.docname, found[1]


def drawings_in_the_page(app, document, name):
    """Drawings become part of the page, so that they follow its theme and not the system's."""
    for image in list(document.findall(nodes.image)):
        file = pathlib.Path(app.srcdir, image["uri"])
        if INLINED.search(image["uri"]):
            drawing = re.sub(r"<\?xml.*?\?>\s*", "", file.read_text(encoding="utf-8"))
            image.replace_self(nodes.raw("", drawing, format="html"))


def short_texts(app, document, name):
    """An option such as --near is not broken after its hyphens, nor a cell such as 49.9 %."""
    for kind, length in ((nodes.literal, SHORT), (nodes.entry, SHORT // 2)):
        for node in document.findall(kind):
            if len(node.astext()) <= length:
                node["classes"].append("short")


def setup(app):
    app.connect("doctree-read", anchors_of_raw_html)
    app.connect("doctree-resolved", drawings_in_the_page)
    app.connect("doctree-resolved", short_texts)
    app.connect("build-finished", theme.repair)
    app.connect("autodoc-process-docstring", docstrings.to_restructured_text)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
