"""Each constant of the engine says why it is as it is."""

import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.append(str(ROOT / "scripts"))

from limits import limits  # noqa: E402


def test_every_constant_has_a_reason_beside_it() -> None:
    found = list(limits(ROOT / "native"))
    assert len(found) > 300  # the pattern still finds them
    assert [f"{each.file.relative_to(ROOT)}:{each.line} {each.name}" for each in found if not each.reason] == []


def test_constants_of_one_run_share_the_comment_over_it_and_no_others(tmp_path: Path) -> None:
    (tmp_path / "a.cpp").write_text(
        "// Of both.\nconstexpr int one = 1;\nconstexpr int two = 2;\n\nconstexpr int three = 3;\n"
        "constexpr double four{4.0};  // edges\nconstexpr int function(int five = 5);\n"
    )
    found = [(each.name, each.value, each.reason) for each in limits(tmp_path)]
    assert found == [("one", "1", "Of both."), ("two", "2", "Of both."), ("three", "3", ""), ("four", "4.0", "edges")]
