"""The reference of the Python module: a directive for each public name, which Sphinx fills from the docstrings."""

import ast
import pathlib
import re

package = pathlib.Path(__file__).resolve().parent.parent.parent / "lib/python/fathom"

GROUPS = {
    "Rendering": ["render"],
    "Scenes": ["Scene", "scene.Object", "scene.Origin"],
    "Cameras": ["Camera", "Lens", "read_cameras", "write_cameras", "ViewWarning"],
    "Rays": ["Rays", "compat.RaycastingScene", "compat.RayMeshIntersector", "compat.Hits", "compat.Tensor"],
    "Maps": ["Map", "read_map", "compare", "MapComparison", "NO_SURFACE", "NO_SEGMENT"],
    "Sight": ["SurfacePoints"],
    "Drawings": ["draw"],
    "Questions": ["probe", "questions.CoveringTriangle", "visible", "questions.VisibleAreas", "questions.PixelAreas",
                  "areas", "Areas", "lit_areas.ExactArea",
                  "render_deep", "DeepMap", "verify", "questions.Verification", "questions.Disagreement"],
    "Evaluation": ["evaluate", "evaluation.Evaluation", "evaluation.Depth", "evaluation.Distances"],
    "Depth formats": ["DepthFormat"],
    "Validation": ["validate", "Validation", "testing.assert_depth"],
    "Data sets": ["doctor", "Diagnosis", "diagnosis.DataSetFault", "diagnosis.Agreement", "diagnosis.Noise"],
    "Studies": ["studies.run", "studies.names", "studies.Study", "studies.Description"],
    "Clipping": ["clip", "clipping.Polygon"],
    "Scan conversion": ["scan", "scanning.algorithms", "scanning.Answer"],
    "The textbooks' pipeline": ["pipeline.render", "pipeline.Picture", "pipeline.trace", "pipeline.run", "pipeline.stages"],
    "Errors": ["Error", "InputError", "UsageError", "OutputError"],
}


def public_names():
    """fathom.__all__, read without the module."""
    tree = ast.parse((package / "__init__.py").read_text(encoding="utf-8"))
    return next(ast.literal_eval(node.value) for node in tree.body
                if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__")


def constants():
    """Name: text; in maps.py a comment."""
    comments = re.findall(r"^#: (.+)\n([A-Z_]+) = ", (package / "maps.py").read_text(encoding="utf-8"), re.M)
    return {"__version__": "The version of Fathom.", **{name: comment for comment, name in comments}}


def directive(name):
    word = name.rpartition(".")[2]
    if word in constants():
        return f".. autodata:: fathom.{name}\n\n   {constants()[word]}\n"
    if not word[0].isupper():
        return f".. autofunction:: fathom.{name}\n"
    if word.endswith(("Error", "Warning")):
        return f".. autoexception:: fathom.{name}\n   :show-inheritance:\n"
    return f".. autoclass:: fathom.{name}\n   :members:\n   :undoc-members:\n"


def text():
    listed = {name for names in GROUPS.values() for name in names} | {"pipeline", "compat"}  # modules, by their members
    groups = {**GROUPS, "Other names": [name for name in public_names() if name not in listed]}
    parts = []
    for title, names in groups.items():
        if names:
            body = "\n".join([".. py:currentmodule:: fathom\n", *map(directive, names)])
            parts.append(f"## {title}\n\n```{{eval-rst}}\n{body}```\n")
    return "\n".join(parts)
