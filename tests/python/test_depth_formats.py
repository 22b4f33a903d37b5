"""fathom.DepthFormat: judged by fractions."""

from fractions import Fraction

import numpy as np
import pytest

import fathom
from fathom.depth_formats import MAPPINGS, STORAGES


def exact_standard(depth, near, far):
    d, n, f = Fraction(depth), Fraction(near), Fraction(far)
    return f * (d - n) / (d * (f - n))


def nearest_even(value):
    return round(value)  # Fraction rounds half to even


@pytest.mark.parametrize("bits", [16, 24, 32])
def test_encode_is_the_exact_code(bits):
    near, far = 0.1, 100.0
    depths = np.concatenate([[near, far], np.random.default_rng(1).uniform(near, far, 500)])
    format = fathom.DepthFormat("standard", f"unorm{bits}", near=near, far=far)
    codes = format.encode(depths)
    assert codes.tolist() == [nearest_even(exact_standard(d, near, far) * (2**bits - 1)) for d in depths]
    assert format.greatest == 2**bits - 1 and codes[1] == format.greatest
    back = format.decode(codes)
    for code, depth in zip(codes.tolist(), back):
        v = Fraction(code, 2**bits - 1)
        n, f = Fraction(near), Fraction(far)
        assert depth == float(f * n / (f - v * (f - n)))


def test_floats_are_bits():
    format = fathom.DepthFormat("linear", "float32", near=1, far=3)
    stored = format.encode([[1, 2], [2.5, 3]])
    assert stored.shape == (2, 2)
    assert np.array_equal(stored.astype(np.uint32).view(np.float32), np.array([[0, 0.5], [0.75, 1]], np.float32))
    assert np.array_equal(format.values(stored), [[0, 0.5], [0.75, 1]])


def test_resolution():
    format = fathom.DepthFormat("linear", "unorm16", near=1, far=65536)
    nearer, farther = format.resolution([1, 8, 65536])
    assert np.array_equal(nearer, [np.nan, 1, 1], equal_nan=True) and np.array_equal(farther, [1, 1, np.nan], equal_nan=True)
    assert format.bin_width(8) == 1 and format.codes_between(3, 10) == 8
    assert format.separation_behind(7.25) == 0.25


@pytest.mark.parametrize("mapping", MAPPINGS)
@pytest.mark.parametrize("storage", STORAGES)
def test_every_format_goes_there_and_back(mapping, storage):
    far = np.inf if "infinite" in mapping else 50
    format = fathom.DepthFormat(mapping, storage, near=0.5, far=far)
    depths = np.linspace(0.5, 50, 33)
    stored = format.encode(depths)
    steps = np.diff(stored.astype(np.int64))
    assert (steps <= 0).all() if "reversed" in mapping else (steps >= 0).all()
    assert np.array_equal(format.encode(format.decode(stored), clamp=True), stored)


@pytest.mark.parametrize("call, error, words", [
    (lambda: fathom.DepthFormat("standart", "unorm16", near=1, far=2), ValueError, "mapping: expected 'standard'"),
    (lambda: fathom.DepthFormat("standard", "unorm8", near=1, far=2), ValueError, "storage: expected 'unorm16'"),
    (lambda: fathom.DepthFormat("standard", "unorm16", near=0, far=2), ValueError, "near"),
    (lambda: fathom.DepthFormat("standard", "unorm16", near=1, far=np.inf), ValueError, "far"),
    (lambda: fathom.DepthFormat("linear", "unorm16", near=1, far=2).encode(3), ValueError, "3"),
    (lambda: fathom.DepthFormat("linear", "unorm16", near=1, far=2).encode([np.nan]), ValueError, "NaN"),
    (lambda: fathom.DepthFormat("linear", "unorm16", near=1, far=2).decode([65536]), ValueError, "0 to 65535"),
    (lambda: fathom.DepthFormat("linear", "unorm16", near=1, far=2).decode([-1]), ValueError, "from 0 on"),
    (lambda: fathom.DepthFormat("linear", "unorm16", near=1, far=2).decode([0.5]), TypeError, "expected integers"),
])
def test_what_formats_refuse(call, error, words):
    with pytest.raises(error, match=words):
        call()


@pytest.mark.parametrize("storage, bits", [
    ("unorm24", 2**24),
    ("float16", 0xFFFF),  # NaN
    ("float32", 0x7FC00000),  # NaN
    ("float32", 0x3F800001),  # just above 1
    ("float64", 0xBFF0000000000000),  # -1
])
def test_what_is_no_stored_value_is_neither_decoded_nor_a_value(storage, bits):
    format = fathom.DepthFormat("linear", storage, near=1, far=2)
    assert format.values([0, format.greatest]).tolist() == [0, 1]
    for read in (format.decode, format.values):
        with pytest.raises(fathom.InputError, match=f"stored: expected values from 0 to {format.greatest}, found {bits}"):
            read(np.array([0, bits], np.uint64))


@pytest.mark.parametrize("storage", ["float16", "float32", "float64"])
def test_numbers_of_a_float_storage_are_its_stored_values(storage):
    format = fathom.DepthFormat("standard", storage, near=0.1, far=100)
    bits = format.encode([0.1, 1, 7, 100])
    numbers = np.array(format.values(bits), storage)
    assert format.decode(numbers.reshape(2, 2)).tolist() == format.decode(bits.reshape(2, 2)).tolist()
    with pytest.raises(fathom.InputError, match="stored: expected values from 0"):
        format.decode(np.array([1.5], storage))


def test_numbers_of_codes_become_codes_as_the_message_says():
    format = fathom.DepthFormat("standard", "unorm24", near=0.1, far=100)
    codes = format.encode([0.1, 1, 7, 100])
    numbers = format.values(codes).astype(np.float32)
    with pytest.raises(TypeError, match="found float32 for unorm24; np.rint(.*) makes codes of numbers"):
        format.decode(numbers)
    assert np.rint(numbers * np.float64(format.greatest)).astype(int).tolist() == codes.tolist()


def test_the_documentation_has_the_names():
    for name in MAPPINGS + STORAGES:
        assert f'"{name}"' in fathom.DepthFormat.__doc__


def test_clamp():
    format = fathom.DepthFormat("linear", "unorm16", near=1, far=2)
    assert format.encode([-np.inf, 0, 9, np.inf], clamp=True).tolist() == [0, 0, 65535, 65535]
