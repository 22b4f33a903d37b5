from typing import Any

from ._core import Camera, Scene

def names_of_studies() -> list[tuple[str, str, bool]]: ...
def run_study(
    name: str,
    scene: Scene | None,
    camera: Camera | None,
    depths: tuple[float | None, ...],
    samples: int | None,
    plots: bool,
) -> tuple[dict[str, bytes], dict[str, list[tuple[str, str, list[Any]]]]]: ...
