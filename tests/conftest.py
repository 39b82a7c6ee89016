"""Options of the suite."""

import pytest
from hypothesis import settings


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--thorough", action="store_true", help="run the slow tests too")


def pytest_configure(config: pytest.Config) -> None:
    """Five properties: 200 examples, always the same ones; with --thorough 2000, other ones each time."""
    settings.register_profile("quick", max_examples=40, derandomize=True, deadline=None, database=None)
    settings.register_profile("thorough", max_examples=400, deadline=None, database=None, print_blob=True)
    settings.load_profile("thorough" if config.getoption("--thorough") else "quick")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if config.getoption("--thorough"):
        return
    skip = pytest.mark.skip(reason="slow; run with --thorough")
    for item in items:
        if "slow" in item.keywords:
            item.add_marker(skip)
