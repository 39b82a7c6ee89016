"""mkdocs' hooks: links that leave docs/ or name files, and the docstrings' roles, read well on the site."""

import re
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File

PAGES = ("CONTRIBUTING.md", "CHANGELOG.md")
NAMED = re.compile(r"\[[\w/]+\.md\]\(([\w/.]+\.md)")
TITLE = re.compile(r"^# (.+)$", re.MULTILINE)
ROLE = re.compile(r":(?:func|class|meth|data|exc):(?=<code>)")
FROM_DOCS = re.compile(r"\]\(((?:\.\./)*)docs/")


def on_files(files: Any, /, *, config: Any) -> Any:
    """Add these pages, their links to docs/ made those of a page in it."""
    for name in PAGES:
        text = (Path(config.docs_dir).parent / name).read_text(encoding="utf-8")
        files.append(File.generated(config, name, content=FROM_DOCS.sub("](", text)))
    return files


def on_page_markdown(markdown: str, /, *, page: Any, config: Any, **_: Any) -> str:
    """Links that leave docs/ for one of these pages stay in the site; of others, which have no address, the words.

    Links that say a file's name say its page's title.
    """
    up = "../" * (page.file.src_uri.count("/") + 1)
    for name in PAGES:
        markdown = markdown.replace(f"]({up}{name}", f"]({up[3:]}{name}")
    markdown = re.sub(rf"(?<!!)\[([^\[\]]+)\]\({re.escape(up)}[^()\s]+\)", r"\1", markdown)
    docs = Path(config.docs_dir)
    folder = (docs / page.file.src_uri).parent
    return NAMED.sub(lambda link: f"[{_title(docs, folder / link[1])}]({link[1]}", markdown)


def _title(docs: Path, path: Path) -> str:
    """The heading of a page, for a link whose words are the file's name."""
    found = TITLE.search((docs.parent / path.name if path.name in PAGES else path).read_text(encoding="utf-8"))
    return found[1] if found else path.name


def on_page_content(html: str, /, **_: Any) -> str:
    """Docstrings name what they refer to by roles, which Markdown doesn't have: the names alone."""
    return ROLE.sub("", html)
