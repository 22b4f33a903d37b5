import pytest

from farm_runs import Farm


@pytest.fixture
def farm(tmp_path):
    """A folder as docs/farms.md has it."""
    return Farm(tmp_path)
