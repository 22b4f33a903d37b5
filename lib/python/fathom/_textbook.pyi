import numpy as np
import numpy.typing as npt

from ._core import Camera, Scene

class ScanRequest:
    def __init__(
        self,
        algorithm: str,
        arithmetic: str,
        trace: bool,
        runs: bool,
        draw: bool,
        subpixel_bits: int | None,
        ties: str | None,
        edges: str | None,
    ) -> None: ...

def scan_algorithms() -> list[str]: ...
def scan_case(case: str, request: ScanRequest) -> tuple[str, str]: ...
def run_stage(stage: str, record: str, binary64: bool) -> str: ...
def stages() -> list[tuple[str, str, str]]: ...
def trace(
    scene: Scene,
    camera: Camera,
    number: int,
    pixel: tuple[int, int] | None,
    fragments: bool,
    words: list[str],
    draw: bool,
) -> tuple[str, str, bool]: ...
def render(
    scene: Scene, camera: Camera, words: list[str]
) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.uint32], npt.NDArray[np.uint8], Camera, str, bool]: ...
