#!/usr/bin/env python3
"""Writes points that OpenCV's projectPoints distorts: the lines of points_of_opencv.txt.

Each line: 14 numbers of distortion, x and y of the ray (x, y, 1), and the image of a camera with
fx = fy = 100 and cx = cy = 0, all as hexadecimal floating-point numbers.
"""

import random

import cv2
import numpy as np

random.seed(1)
K = np.diag([100.0, 100.0, 1.0])
for count in (4, 5, 8, 12, 14):
    for _ in range(12):
        numbers = [random.uniform(-0.2, 0.2) for _ in range(count)]
        for i in range(2, min(count, 4)):
            numbers[i] *= 0.1
        ray = np.array([[random.uniform(-1, 1), random.uniform(-1, 1), 1.0]])
        image, _ = cv2.projectPoints(ray, np.zeros(3), np.zeros(3), K, np.array(numbers))
        numbers += [0.0] * (14 - count)
        print(*(float(x).hex() for x in [*numbers, ray[0, 0], ray[0, 1], *image[0, 0]]))
