"""The pages of the project: links lead somewhere, files that are named exist, lines of prose are short."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")])
LINK = re.compile(r"\]\(([^)\s]+)\)")
FILE = re.compile(r"`((?:addon|benchmarks|docs|native|scripts|tests)/[\w./-]+)`")
# A file and what it defines or calls, as the walks of docs/architecture.md have them.
WALK = re.compile(r"`((?:addon|native)/[\w/]+\.\w+)` \(((?:`\w+`(?:, )?)+)\)")
# Words of which docs/method.md's glossary has the field's own; callers rely on outline="mended" and its like.
SWEPT = re.compile(r"\b(needles?|settle[sd]?|engine's own mesh|outlines?)\b(?![=:\"'`,)(\]])")
# Figures make some of their lines long.
GENERATED = ("docs/paper.md", "docs/performance.md")


def name(page: Path) -> str:
    return str(page.relative_to(ROOT))


def prose(page: Path) -> list[str]:
    """Lines outside code and tables."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    return [line for line in text.splitlines() if not line.startswith("|")]


def anchors(page: Path) -> set[str]:
    """What a link can point to within a page."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_links_lead_somewhere(page: Path) -> None:
    for link in LINK.findall(page.read_text(encoding="utf-8")):
        if link.startswith("http"):
            continue
        file, _, anchor = link.partition("#")
        target = page.parent / file if file else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_files_that_are_named_exist(page: Path) -> None:
    for file in FILE.findall(page.read_text(encoding="utf-8")):
        assert (ROOT / file).exists() or list(ROOT.glob(f"{file}.*")), file


@pytest.mark.parametrize("folder", ["addon", "docs", "native", "scripts", "tests"])
def test_words_are_the_fields(folder: str) -> None:
    texts = [file for kind in ("md", "py", "h", "cpp", "toml") for file in (ROOT / folder).rglob(f"*.{kind}")]
    lines = [(file.name, line) for file in texts for line in file.read_text(encoding="utf-8").splitlines()]
    assert [(name, line) for name, line in lines if SWEPT.search(line) and "SWEPT" not in line] == []


def test_walks_name_functions_that_are_there() -> None:
    steps = WALK.findall((ROOT / "docs/architecture.md").read_text(encoding="utf-8"))
    assert len(steps) > 25
    for file, names in steps:
        text = (ROOT / file).read_text(encoding="utf-8")
        assert [
            word for word in re.findall(r"\w+", names) if not re.search(rf"\b{word}\(|\bclass {word}\b", text)
        ] == [], file


@pytest.mark.parametrize("page", [page for page in PAGES if name(page) not in GENERATED], ids=name)
def test_lines_of_prose_are_short(page: Path) -> None:
    assert [line for line in prose(page) if len(line) > 120] == []


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_the_site_sees_lists_and_pictures(page: Path) -> None:
    """It takes them for text where they are indented by less than four, or follow a line of text."""
    above, bad = "", []
    for line in prose(page):
        item = re.match(r" *(- |1\. )", line)
        if item and above and not re.match(r" *(- |\d+\. |#|<!--)|  +\S", above):
            bad.append(line)
        above = line
    assert bad + [line for line in prose(page) if re.match(r" {1,3}(- |\d+\. |!\[)", line)] == []


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_tables_are_whole(page: Path) -> None:
    """Each begins with a heading and a rule: a row after an empty line is no row of any."""
    for table in re.findall(r"(?:^\|.*\n)+", page.read_text(encoding="utf-8"), re.MULTILINE):
        assert re.match(r"\|.*\n\|[ :|-]+\|\n", table), table


@pytest.mark.parametrize(
    ("page", "template"),
    [("docs/performance.md", "benchmarks/peers/page.md"), ("docs/paper.md", "benchmarks/paper/page.md")],
)
def test_page_and_template_have_the_same_words(page: str, template: str) -> None:
    words = re.split(r"\{\{\w+\}\}", (ROOT / template).read_text(encoding="utf-8"))
    assert len(words) > 1
    pattern = ".*?".join(re.escape(part) for part in words)
    assert re.fullmatch(pattern, (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)


def test_every_page_of_the_docs_is_in_the_sites_menu() -> None:
    """And the menu names no page that isn't there."""
    menu = (ROOT / "mkdocs.yml").read_text(encoding="utf-8").split("\nnav:\n")[1]
    named = set(re.findall(r"[\w/]+\.md", menu)) - {"CONTRIBUTING.md", "CHANGELOG.md"}
    assert named == {str(page.relative_to(ROOT / "docs")) for page in PAGES if ROOT / "docs" in page.parents}


def test_pictures_are_shown_and_are_not_too_large() -> None:
    """400 kB each, 12 MB in all."""
    pictures = {path.name: path.stat().st_size for path in (ROOT / "docs/pictures").iterdir()}
    shown = {Path(link).name for page in PAGES for link in LINK.findall(page.read_text(encoding="utf-8"))}
    assert set(pictures) - shown == set()
    assert max(pictures.values()) <= 400_000
    assert sum(pictures.values()) <= 12_000_000
    # The 26th byte of a PNG is its kind of colour: palettes show bands on smooth surfaces; WebP has 24 bits.
    assert [path.name for path in (ROOT / "docs/pictures").glob("*.png") if path.read_bytes()[25] == 3] == []
