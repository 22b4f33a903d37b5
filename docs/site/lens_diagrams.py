#!/usr/bin/python3
"""Draws docs/images/lenses-models.svg of docs/lenses.md.

    lens_diagrams.py [FOLDER]       (default: docs/images)

The lenses and their forward maps are below; tests/python/test_lenses.py holds them to what the library computes, and the
picture to this program.
"""

import math

from diagrams import drawing, main, text

# The image that each lens draws, in pixels; its principal point is the middle.
WIDTH, HEIGHT = 240, 180
LENSES = [
    {"title": "no lens", "model": "PINHOLE", "distortion": (), "note": "straight lines stay straight"},
    {"title": "barrel", "model": "SIMPLE_RADIAL", "distortion": (-0.25,), "note": "grey: beyond the fold, no ray"},
    {"title": "pincushion", "model": "SIMPLE_RADIAL", "distortion": (0.2,), "note": "k above 0"},
    {"title": "decentred", "model": "OPENCV", "distortion": (0.05, 0, 0.03, -0.05), "note": "p1 and p2: tangential terms"},
    {"title": "tilted sensor", "model": "OPENCV_14", "distortion": (0,) * 12 + (0.3, -0.25), "note": "tauX and tauY"},
    {"title": "stereographic", "model": "FISHEYE_STEREOGRAPHIC", "distortion": (), "note": "more than a hemisphere",
     "focal": 62},
]
# The lines x = … and y = … of the plane z = 1: LINES on each side of the middle, up to SPAN, or with equal angles up to the
# horizon; and the points of a line on each side of its middle.
SPAN = 1.5
LINES = 6
POINTS = 20


def focal_length(lens):
    return lens.get("focal", 160)


def params(lens):
    """All parameters of the model, in order."""
    one = lens["model"].startswith("SIMPLE_")
    return (*(focal_length(lens),) * (1 if one else 2), WIDTH / 2, HEIGHT / 2, *lens["distortion"])


def image_of(lens, x, y):
    """Where the lens shows the point (x, y, 1), in pixels from the top left corner."""
    q = x * x + y * y
    numbers = lens["distortion"]
    if lens["model"] == "SIMPLE_RADIAL":
        x, y = x * (1 + numbers[0] * q), y * (1 + numbers[0] * q)
    elif lens["model"] == "OPENCV":
        k1, k2, p1, p2 = numbers
        factor = 1 + k1 * q + k2 * q * q
        x, y = x * factor + 2 * p1 * x * y + p2 * (q + 2 * x * x), y * factor + p1 * (q + 2 * y * y) + 2 * p2 * x * y
    elif lens["model"] == "OPENCV_14":
        x, y = tilted(x, y, *numbers[12:])
    elif lens["model"] == "FISHEYE_STEREOGRAPHIC":
        half = 2 / (1 + math.sqrt(1 + q))  # 2 tan(θ/2) / tan θ
        x, y = x * half, y * half
    return focal_length(lens) * x + WIDTH / 2, focal_length(lens) * y + HEIGHT / 2


def tilted(x, y, about_x, about_y):
    """The point of the tilted sensor: M·(x, y, 1) of the specification, section 2."""
    cx, sx, cy, sy = math.cos(about_x), math.sin(about_x), math.cos(about_y), math.sin(about_y)
    rows = ((cy, sy * sx, -sy * cx), (0, cx, sx), (sy, -cy * sx, cy * cx))
    a, b, c = (row[0] * x + row[1] * y + row[2] for row in rows)
    third, first, second = rows[2][2], rows[0][2], rows[1][2]
    return (third * a - first * c) / c, (third * b - second * c) / c


def fold_radius(lens):
    """The radius in the image beyond which no ray leads, in pixels; None if the whole image is seen."""
    if lens["model"] != "SIMPLE_RADIAL" or lens["distortion"][0] >= 0:
        return None
    radius = 1 / math.sqrt(-3 * lens["distortion"][0])
    return focal_length(lens) * radius * 2 / 3


def curves(lens):
    """The images of the lines of the grid, as lists of points. Points beyond the fold are left out."""
    def places(count):
        steps = [i / count for i in range(-count, count + 1)]
        if lens["model"] != "FISHEYE_STEREOGRAPHIC":
            return [SPAN * step for step in steps]
        return [math.tan(math.pi / 2 * step) for step in steps[1:-1]]

    fold = fold_radius(lens)
    limit = math.inf if fold is None else 1.5 * fold / focal_length(lens)
    for first in places(LINES):
        for pairs in ([(first, second) for second in places(POINTS)], [(second, first) for second in places(POINTS)]):
            yield [image_of(lens, x, y) for x, y in pairs if math.hypot(x, y) <= limit]


def models_picture():
    parts = [f'<defs><clipPath id="lens-image"><rect width="{WIDTH}" height="{HEIGHT}"/></clipPath></defs>']
    for number, lens in enumerate(LENSES):
        left, top = 20 + number % 3 * (WIDTH + 20), 58 + number // 3 * (HEIGHT + 66)
        parts += [text(left, top - 26, lens["title"], "title"), text(left, top - 8, lens["note"], "note"),
                  f'<g transform="translate({left} {top})" clip-path="url(#lens-image)">']
        fold = fold_radius(lens)
        if fold is not None:
            parts.append(f'<path d="M0 0h{WIDTH}v{HEIGHT}h-{WIDTH}z M{WIDTH / 2 - fold:.2f} {HEIGHT / 2:g}'
                         f'a{fold:.2f} {fold:.2f} 0 1 0 {2 * fold:.2f} 0a{fold:.2f} {fold:.2f} 0 1 0 -{2 * fold:.2f} 0z" '
                         'fill-rule="evenodd" class="fd-soft"/>')
        for curve in curves(lens):
            if len(curve) > 1:
                points = " ".join(f"{u:.1f},{v:.1f}" for u, v in curve)
                parts.append(f'<polyline points="{points}" class="fd-thin"/>')
        parts += ["</g>", f'<rect x="{left}" y="{top}" width="{WIDTH}" height="{HEIGHT}" class="fd-line"/>']
    return drawing(3 * (WIDTH + 20) + 20, 2 * (HEIGHT + 66) + 14, "A grid of straight lines, as six lenses draw it", parts)


PICTURES = {"lenses-models.svg": models_picture}


if __name__ == "__main__":
    main(PICTURES)
