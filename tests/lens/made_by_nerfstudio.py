#!/usr/bin/env python3
"""Writes points that Nerfstudio's distortion of perspective cameras takes to their images: the lines of
points_of_nerfstudio.txt.

    made_by_nerfstudio.py nerfstudio/cameras/camera_utils.py

The file is the one of github.com/nerfstudio-project/nerfstudio, 50e0e3c7. Its function needs arithmetic only, so that
PyTorch is not needed. Each line: BROWN, its parameters in Fathom's order, x, y and z of a ray, and its image, as
hexadecimal floating-point numbers.
"""

import ast
import pathlib
import random
import sys

import numpy as np

NAME = "_compute_residual_and_jacobian"


def residual_function(file):
    """The function, without its annotations and decorators."""
    function, = (each for each in ast.parse(pathlib.Path(file).read_text()).body
                 if isinstance(each, ast.FunctionDef) and each.name == NAME)
    function.decorator_list = []
    names = {}
    for each in ast.walk(function):
        if isinstance(each, ast.arg):
            each.annotation = None
    function.returns = None
    exec(compile(ast.Module([function], []), file, "exec"), names)
    return names[NAME]


def main():
    residual = residual_function(sys.argv[1])
    random.seed(1)
    for _ in range(12):
        k1, k2, k3, k4 = (random.uniform(-0.2, 0.2) for _ in range(4))
        p1, p2 = (random.uniform(-0.02, 0.02) for _ in range(2))
        fx, fy, cx, cy = (*(random.uniform(90, 110) for _ in range(2)), *(random.uniform(-5, 5) for _ in range(2)))
        x, y = (random.uniform(-0.7, 0.7) for _ in range(2))
        distorted = residual(x=x, y=y, xd=0.0, yd=0.0, distortion_params=np.array([k1, k2, k3, k4, p1, p2]))[:2]
        numbers = [fx, fy, cx, cy, k1, k2, k3, k4, p1, p2, x, y, 1.0, fx * distorted[0] + cx, fy * distorted[1] + cy]
        print("BROWN", *(float(number).hex() for number in numbers))


if __name__ == "__main__":
    main()
