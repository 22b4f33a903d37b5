#!/usr/bin/env python3
"""Writes points that OpenCV undistorts: the lines of inverted_by_opencv.txt.

Each line: the numbers k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 of a lens, a point of the plane in which it distorts, and the
points that 5 steps (cv2.undistortPoints) and 20 steps (cv2.undistortPointsIter) find, as hexadecimal floating-point
numbers.
"""

import random

import cv2
import numpy as np

random.seed(1)
K = np.diag([256.0, 256.0, 1.0])  # divisions by a power of two are exact
TWENTY = (cv2.TERM_CRITERIA_COUNT, 20, 0)
# The last lens has a negative L near the corners.
SIZES = [(2, 0.3), (4, 0.3), (5, 0.3), (8, 0.3), (12, 0.3), (2, 2)]
for count, size in SIZES:
    for _ in range(10):
        numbers = np.zeros(14)
        numbers[:4 if count == 2 else count] = [random.uniform(-size, size) for _ in range(4 if count == 2 else count)]
        numbers[2:4] *= 0 if count == 2 else 0.1
        numbers[8:] *= 0.1
        point = np.array([[[random.uniform(-1, 1), random.uniform(-1, 1)]]])
        five = cv2.undistortPoints(256 * point, K, numbers)
        twenty = cv2.undistortPointsIter(256 * point, K, numbers, np.eye(3), np.eye(3), TWENTY)
        print(*(float(x).hex() for x in [*numbers[:12], *point.ravel(), *five.ravel(), *twenty.ravel()]))
