"""A checkout of thodan/bop_toolkit, run as it is: nothing of it is copied or changed.

Three things are supplied from outside, so that it runs with Debian bookworm's packages and without a display:

- `imageio.v2`, which its inout.py imports, is imageio itself where the one installed (2.4.1) is older than that name;
- EGL_PLATFORM=surfaceless, unless it is set: vispy asks EGL for the default display, and Mesa has none without it;
- set_current() before each drawing: the toolkit keeps a canvas for each size of image, and draws into the one made last.

Its renderer decides PYOPENGL_PLATFORM and vispy's backends itself.
"""

import argparse
import importlib
import os
import pathlib
import sys


def use(checkout):
    """From here on `bop_toolkit_lib` can be imported."""
    os.environ.setdefault("EGL_PLATFORM", "surfaceless")
    sys.path.insert(0, str(pathlib.Path(checkout).resolve()))
    try:
        importlib.import_module("imageio.v2")
    except ImportError:
        sys.modules["imageio.v2"] = importlib.import_module("imageio")


def versions(renderer):
    """What the figures depend on, a line each."""
    import vispy
    from OpenGL import GL

    renderer.set_current()
    renderer.fbo.activate()
    renderer.context.flush_commands()
    bits = GL.glGetFramebufferAttachmentParameteriv(GL.GL_FRAMEBUFFER, GL.GL_DEPTH_ATTACHMENT,
                                                    GL.GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE)
    return [f"vispy {vispy.__version__}", f"{GL.glGetString(GL.GL_RENDERER).decode()}, "
            f"OpenGL {GL.glGetString(GL.GL_VERSION).decode()}",
            f"{int(bits)} bits of depth, {int(GL.glGetIntegerv(GL.GL_SUBPIXEL_BITS))} subpixel bits"]


class Renderer:
    """The toolkit's vispy renderer with the models of a folder, for images of one size. `shift` is added to the
    principal point that it is given."""

    def __init__(self, folder, size, shift=0):
        from bop_toolkit_lib.rendering import renderer

        self.shift = shift
        self.own = renderer.create_renderer(*size, "vispy", mode="depth")
        for file in sorted(pathlib.Path(folder).glob("models/obj_*.ply")):
            if int(file.stem[4:]) not in self.own.models:         # it keeps one instance for each size
                self.own.add_object(int(file.stem[4:]), str(file))

    def depth(self, instance, K, offset=(0, 0)):
        """H×W float32 millimetres, 0 for none; then also (near, far) as it has chosen them."""
        self.own.set_current()
        cx, cy = K[0, 2] + offset[0] + self.shift, K[1, 2] + offset[1] + self.shift
        drawn = self.own.render_object(instance.obj_id, instance.R, instance.t.reshape(3, 1), K[0, 0], K[1, 1], cx, cy)
        drawn = drawn["depth"]
        return drawn.copy(), (float(self.own.clip_near), float(self.own.clip_far))


def arguments(description):
    """FOLDER and --bop-toolkit of the scripts that compare, and the checkout in use."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--bop-toolkit", required=True, metavar="CHECKOUT")
    asked = parser.parse_args()
    use(asked.bop_toolkit)
    return asked
