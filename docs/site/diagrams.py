#!/usr/bin/python3
"""Draws the pictures of docs/conventions-in-pictures.md.

    diagrams.py [FOLDER]            (default: docs/images)

What they state is in the lists below; tests/python/test_diagrams.py holds it to what the library computes, and the files
to this program.
"""

import math
import pathlib
import sys

# A point in front of a camera, by words, and its coordinates in each program's camera frame.
RIGHT, DOWN, FORWARD = 1, 2, 5
FRAMES = [
    {"programs": "Fathom, OpenCV, COLMAP, BOP", "axes": ("right", "down", "forward"),
     "matrix": "world to camera", "to_fathom": (1, 1, 1)},
    {"programs": "OpenGL, NeRF, Blender, VTK", "axes": ("right", "up", "backward"),
     "matrix": "NeRF, Blender: camera to world", "to_fathom": (1, -1, -1)},
    {"programs": "PyTorch3D", "axes": ("left", "up", "forward"),
     "matrix": "world to camera, row vectors", "to_fathom": (-1, -1, 1)},
]

# An image of 4 × 3 pixels: the same camera, the principal point in the middle, and the same pixel in both countings.
COLUMNS, ROWS = 4, 3
COUNTINGS = [
    {"pixel_centre": 0.5, "programs": "COLMAP, NeRF, OpenGL"},
    {"pixel_centre": 0, "programs": "OpenCV's calibration, BOP"},
]
COLUMN, ROW = 2, 1

# A wall at planar depth 4, and two points of it: on the axis, and to the side.
WALL = 4
SIDES = (0, 3)

STYLE = """
svg.fathom-diagram { --ink: #1b1f24; --faint: #6a727c; --paper: #ffffff; --soft: #eef1f4; --x: #c62828; --y: #1b7f3b;
  --z: #1565c0; font: 16px system-ui, "DejaVu Sans", sans-serif; }
@media (prefers-color-scheme: dark) {
  svg.fathom-diagram { --ink: #e6e8eb; --faint: #98a1ab; --paper: #16181b; --soft: #252a30; --x: #ff7b72; --y: #56d364;
    --z: #79b8ff; }
}
.fd-paper { fill: var(--paper); stroke: var(--faint); stroke-opacity: 0.4; }
.fd-text { fill: var(--ink); } .fd-note { fill: var(--faint); font-size: 14.5px; } .fd-title { fill: var(--ink); font-weight: 600; }
.fd-code { fill: var(--ink); font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: 15px; }
.fd-small { fill: var(--ink); font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: 12.5px; }
.fd-line { stroke: var(--ink); fill: none; stroke-width: 1.5; } .fd-thin { stroke: var(--faint); fill: none; }
.fd-soft { fill: var(--soft); stroke: var(--faint); } .fd-dot { fill: var(--ink); } .fd-mark { fill: var(--x); }
.fd-x { stroke: var(--x); } .fd-y { stroke: var(--y); } .fd-z { stroke: var(--z); }
.fd-x, .fd-y, .fd-z { fill: none; stroke-width: 2.5; }
.fd-xt { fill: var(--x); font-weight: 600; } .fd-yt { fill: var(--y); font-weight: 600; } .fd-zt { fill: var(--z); font-weight: 600; }
"""


def number(value):
    """As a reader writes it, with a real minus."""
    return f"{value:g}".replace("-", "−")


def point(values):
    return "(" + ", ".join(map(number, values)) + ")"


def text(x, y, words, kind="text", anchor="start"):
    return f'<text x="{x:g}" y="{y:g}" class="fd-{kind}" text-anchor="{anchor}">{words}</text>'


def line(x1, y1, x2, y2, kind="line", dashed=False):
    dashes = ' stroke-dasharray="4 4"' if dashed else ""
    return f'<line x1="{x1:g}" y1="{y1:g}" x2="{x2:g}" y2="{y2:g}" class="fd-{kind}"{dashes}/>'


def arrow(x1, y1, x2, y2, kind="line"):
    length = math.hypot(x2 - x1, y2 - y1)
    dx, dy = (x2 - x1) / length, (y2 - y1) / length
    wings = " ".join(f"{x2 - 9 * dx + side * 4 * dy:.1f},{y2 - 9 * dy - side * 4 * dx:.1f}" for side in (1, -1))
    first, second = wings.split(" ")
    return line(x1, y1, x2, y2, kind) + f'<polyline points="{first} {x2:g},{y2:g} {second}" class="fd-{kind}"/>'


def dot(x, y, kind="dot", radius=3.5):
    return f'<circle cx="{x:g}" cy="{y:g}" r="{radius:g}" class="fd-{kind}"/>'


def box(x, y, width, height, kind="soft"):
    return f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" class="fd-{kind}"/>'


def drawing(width, height, title, parts):
    body = "\n".join(parts)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" class="fathom-diagram" viewBox="0 0 {width} {height}" role="img" '
            f'aria-label="{title}">\n<title>{title}</title>\n<style>{STYLE}</style>\n'
            f'<rect x="0.5" y="0.5" width="{width - 1}" height="{height - 1}" rx="8" class="fd-paper"/>\n{body}\n</svg>\n')


# How directions are drawn: seen from behind the camera, a little from above and the left.
ON_PAPER = {"right": (78, 0), "left": (-78, 0), "down": (0, 70), "up": (0, -70), "forward": (50, -42),
            "backward": (-50, 42)}
LABEL = {"right": (8, 5, "start"), "left": (-8, 5, "end"), "down": (0, 18, "middle"), "up": (0, -8, "middle"),
         "forward": (-4, -8, "start"), "backward": (-6, 14, "end")}


def coordinates(frame):
    """Of the point RIGHT to the right, DOWN below and FORWARD in front, in a program's camera frame."""
    amounts = {"right": RIGHT, "left": -RIGHT, "down": DOWN, "up": -DOWN, "forward": FORWARD, "backward": -FORWARD}
    return tuple(amounts[axis] for axis in frame["axes"])


def camera(x, y):
    """A camera at (x, y) that looks forward, and the pyramid of what it sees."""
    fx, fy = ON_PAPER["forward"]
    corners = [(x + 0.75 * fx + side * 34, y + 0.75 * fy + height * 25) for side, height in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    outline = " ".join(f"{a:.1f},{b:.1f}" for a, b in corners)
    return [f'<polygon points="{outline}" class="fd-soft" fill-opacity="0.6"/>',
            *[line(x, y, a, b, "thin") for a, b in corners]]


def axes_picture():
    parts, width = [], 305
    for k, frame in enumerate(FRAMES):
        x, y = 20 + k * width + 105, 165
        parts += [text(20 + k * width, 32, frame["programs"], "title"), text(20 + k * width, 52, frame["matrix"], "note")]
        parts += camera(x, y)
        for name, axis in zip("xyz", frame["axes"]):
            dx, dy = ON_PAPER[axis]
            lx, ly, anchor = LABEL[axis]
            parts += [arrow(x, y, x + dx, y + dy, name), text(x + dx + lx, y + dy + ly, f"{name} {axis}", name + "t", anchor)]
        parts += [dot(x, y), text(20 + k * width, 312, point(coordinates(frame)), "code")]
    parts.append(text(20, 288, f"A point {RIGHT} to the right, {DOWN} below and {FORWARD} in front of the camera has the coordinates"))
    return drawing(20 + 3 * width, 330, "Axes of camera frames", parts)


def position(counting, column, row):
    """The image coordinates of a pixel's centre."""
    return column + counting["pixel_centre"], row + counting["pixel_centre"]


def principal_point(counting):
    """cx and cy of the camera whose axis goes through the middle of the image."""
    return COLUMNS / 2 - 0.5 + counting["pixel_centre"], ROWS / 2 - 0.5 + counting["pixel_centre"]


def pixels_picture():
    parts, size = [], 84
    for k, counting in enumerate(COUNTINGS):
        left, top = 66 + k * 450, 116
        centre = counting["pixel_centre"]
        parts += [text(left - 42, 32, f"pixel_centre {number(centre)}", "title"),
                  text(left - 42, 52, counting["programs"], "note")]
        for row in range(ROWS):
            for column in range(COLUMNS):
                kind = "soft" if (column, row) == (COLUMN, ROW) else "thin"
                parts.append(box(left + column * size, top + row * size, size, size, kind))
                parts.append(dot(left + (column + 0.5) * size, top + (row + 0.5) * size, "dot", 2))
        parts += [arrow(left, top - 32, left + 60, top - 32, "x"), text(left + 66, top - 27, "u", "xt"),
                  arrow(left - 40, top, left - 40, top + 60, "y"), text(left - 40, top + 78, "v", "yt", "middle")]
        # Where whole numbers lie: at corners, or at centres.
        for i in range(COLUMNS + (centre == 0.5)):
            at = left + (i + 0.5 - centre) * size
            parts += [line(at, top - 6, at, top), text(at, top - 10, number(i), "note", "middle")]
        for j in range(ROWS + (centre == 0.5)):
            at = top + (j + 0.5 - centre) * size
            parts += [line(left - 6, at, left, at), text(left - 10, at + 5, number(j), "note", "end")]
        parts.append(text(left + size / 2, top + size / 2 + 20, point(position(counting, 0, 0)), "small", "middle"))
        parts.append(text(left + (COLUMN + 0.5) * size, top + (ROW + 0.5) * size + 20,
                          point(position(counting, COLUMN, ROW)), "small", "middle"))
        cx, cy = principal_point(counting)
        parts += [dot(left + COLUMNS / 2 * size, top + ROWS / 2 * size, "mark", 4.5),
                  text(left, top + ROWS * size + 28, f"● cx = {number(cx)}, cy = {number(cy)}", "xt")]
    parts.append(text(24, 428, f"The same camera, and the same map. The grey pixel is array[{ROW}, {COLUMN}]: row {ROW}, column {COLUMN}; "
                               "row 0 is on top."))
    return drawing(880, 450, "Where pixels lie in the image: pixel_centre 0.5 and 0", parts)


def depth_picture():
    scale, x0, y0 = 70, 70, 80
    wall = x0 + WALL * scale
    parts = [line(wall, 40, wall, y0 + 3.6 * scale), text(wall + 10, 52, f"a wall that faces the camera, z = {number(WALL)}", "note")]
    for side in SIDES:
        y, distance = y0 + side * scale, math.hypot(WALL, side)
        parts += [arrow(x0, y0, wall, y, "x"), dot(wall, y),
                  text(wall + 12, y + 5, f"Z = {number(WALL)}, distance = {number(distance)}", "code")]
    foot = y0 + SIDES[1] * scale
    parts += [line(x0, y0, x0, foot, "thin", True), line(x0, foot, wall, foot, "z"),
              text((x0 + wall) / 2, foot + 22, f"planar depth Z = {number(WALL)}", "zt", "middle"),
              text(x0 - 10, (y0 + foot) / 2 + 5, f"x = {number(SIDES[1])}", "note", "end"),
              text(x0 + 24, foot - 30, f"along the ray: {number(math.hypot(WALL, SIDES[1]))}", "xt"),
              dot(x0, y0, "dot", 5), text(x0, y0 - 16, "eye", "text", "middle"), text(x0 + 130, y0 - 10, "z forward", "note"),
              text(wall + 12, y0 + 130, "Z is the same on all of the wall;"), text(wall + 12, y0 + 150, "distance grows to the side.")]
    return drawing(700, 350, "Planar depth and distance along the ray, seen from above", parts)


PICTURES = {"conventions-axes.svg": axes_picture, "conventions-pixels.svg": pixels_picture,
            "conventions-depth.svg": depth_picture}


def main(pictures):
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent / "images"
    for name, draw in pictures.items():
        (folder / name).write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main(PICTURES)
