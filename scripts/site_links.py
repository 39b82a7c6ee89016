"""mkdocs' hooks: files beside docs/ to which its pages lead become pages of the site."""

import re
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File

PAGES = ("CONTRIBUTING.md", "CHANGELOG.md")
FROM_DOCS = re.compile(r"\]\(((?:\.\./)*)docs/")


def on_files(files: Any, /, *, config: Any) -> Any:
    """Add these pages, their links to docs/ made those of a page in it."""
    for name in PAGES:
        text = (Path(config.docs_dir).parent / name).read_text(encoding="utf-8")
        files.append(File.generated(config, name, content=FROM_DOCS.sub("](", text)))
    return files


def on_page_markdown(markdown: str, /, *, page: Any, **_: Any) -> str:
    """Links that leave docs/ for one of these pages stay in the site; of others, which have no address, the words."""
    up = "../" * (page.file.src_uri.count("/") + 1)
    for name in PAGES:
        markdown = markdown.replace(f"]({up}{name}", f"]({up[3:]}{name}")
    return re.sub(rf"(?<!!)\[([^\[\]]+)\]\({re.escape(up)}[^()\s]+\)", r"\1", markdown)
