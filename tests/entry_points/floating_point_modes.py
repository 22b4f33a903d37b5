"""What a program around Fathom may have done to the floating-point environment of a thread."""

import contextlib
import ctypes
import ctypes.util
import mmap
import platform

libm = ctypes.CDLL(ctypes.util.find_library("m"))
is_x86 = platform.machine() == "x86_64"
#: <fenv.h> of glibc.
upwards, downwards, to_zero = (0x800, 0x400, 0xC00) if is_x86 else (0x400000, 0x800000, 0xC00000)
#: How a thread rounds, and whether it takes subnormal numbers for 0.
modes = {"upwards": (upwards, False), "downwards": (downwards, False), "towards zero": (to_zero, False),
         "subnormals are 0": (0, True), "towards zero, subnormals are 0": (to_zero, True)}


def _function(code, *types):
    """A function of machine code, which is never freed."""
    page = mmap.mmap(-1, mmap.PAGESIZE, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
    page.write(code)
    _function.pages.append(page)
    return ctypes.CFUNCTYPE(*types)(ctypes.addressof(ctypes.c_char.from_buffer(page)))


_function.pages = []
# The register that says how SSE rounds and whether it flushes: nothing in Python or the C library sets its last bits.
_read = _function(bytes.fromhex("0fae5c24f8 8b4424f8 c3"), ctypes.c_uint) if is_x86 else None
_write = _function(bytes.fromhex("897c24f8 0fae5424f8 c3"), None, ctypes.c_uint) if is_x86 else None
flush_bits, exception_bits = 0x8040, 0x3F


def current_mode():
    """The mode of this thread, whatever exceptions have been raised."""
    return (libm.fegetround(), _read() & ~exception_bits if is_x86 else 0)


@contextlib.contextmanager
def in_mode(mode):
    """Everything that this thread computes, Python's own work included."""
    rounding, flushes = mode
    before = current_mode()
    libm.fesetround(rounding)
    if flushes and is_x86:
        _write(_read() | flush_bits)
    try:
        yield
        assert current_mode()[0] == rounding, "the mode was not restored"
        assert not is_x86 or bool(current_mode()[1] & flush_bits) == flushes, "the mode was not restored"
    finally:
        if is_x86:
            _write(before[1])
        libm.fesetround(before[0])


def in_every_mode(call):
    """(name, outcome of call()) in each mode, after that in the standard one."""
    yield "standard", call()
    for name, mode in modes.items():
        with in_mode(mode):
            outcome = call()
        yield name, outcome
