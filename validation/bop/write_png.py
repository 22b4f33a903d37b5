"""Masks as PNG of 8 bits, 255 and 0."""

import struct
import zlib

import numpy as np


def write_mask(file, mask):
    height, width = mask.shape
    rows = np.zeros((height, width + 1), np.uint8)              # each begins with its filter, 0: none
    rows[:, 1:] = np.where(mask, 255, 0)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b""))
