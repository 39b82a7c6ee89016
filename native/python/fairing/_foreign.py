"""Another distribution's files in this package's folder."""

from __future__ import annotations

from pathlib import Path

FOREIGN = "fairing"  # on PyPI a tool for machine learning, last released in 2019, whose package has the same name


def refuse_foreign(package: str) -> None:
    """ImportError where a distribution called `fairing` lies beside `intrinsic-fairing`: both write into one folder."""
    for found in Path(package).parent.glob(f"{FOREIGN}-*.dist-info"):
        raise ImportError(
            f"two packages share the folder {package}: intrinsic-fairing, and {found.stem}, which has nothing to do "
            f"with it. Run 'pip uninstall {FOREIGN}', then 'pip install --force-reinstall --no-deps intrinsic-fairing'"
        )
