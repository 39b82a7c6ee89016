"""The extension from a repository, as a first-time user gets it: the pictures of docs/install.md.

FAIRING_REPOSITORY: the address of the repository's folder, without its slash.
"""

import os
import sys
import urllib.request
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import urljoin

sys.path.insert(0, str(Path(__file__).parent))

import addon_utils
import bpy

import scenes
from driver import Story, in_view, middle, move_mouse, play, press, screenshot, view
from panel import open_tab, wait_until

FOLDER = os.environ["FAIRING_REPOSITORY"]
DRAWN = 8.0  # seconds for a dialog to be drawn without a GPU


class Links(HTMLParser):
    """The page's links to zips."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        """Python calls this."""
        address = dict(attributes).get("href") or ""
        if tag == "a" and ".zip" in address:
            self.found.append(address)


def dropped_link() -> str:
    """What a browser hands to Blender: the page's link, with the repository's address in it made whole."""
    with urllib.request.urlopen(f"{FOLDER}/index.html") as page:
        links = Links()
        links.feed(page.read().decode())
    (link,) = links.found
    return urljoin(f"{FOLDER}/", link).replace("repository=.%2Findex.json", f"repository={FOLDER}/index.json")


def is_added() -> bool:
    return any(each.remote_url == f"{FOLDER}/index.json" for each in bpy.context.preferences.extensions.repos)


def is_enabled() -> bool:
    return any(each.module.endswith(".intrinsic_fairing") for each in bpy.context.preferences.addons)


def drop() -> None:
    """What Blender does with a link that is let go over its window."""
    with in_view():
        bpy.ops.extensions.package_install("INVOKE_DEFAULT", url=dropped_link())


def confirm() -> Story:
    """Take the dialog's first answer. Blender swallows the first event in a dialog, so the pointer moves before."""
    x, y = middle()
    for place in (x - 60, x - 50):
        move_mouse(place, y)
        yield 1.0
    press("RET", x - 50, y)


def story() -> Story:
    """Drop, confirm, use."""
    preferences = bpy.context.preferences
    preferences.view.show_splash = False
    preferences.system.use_online_access = True
    preferences.system.use_region_overlap = False
    for repository in preferences.extensions.repos:  # Blender's own is out of reach here
        repository.enabled = not repository.use_remote_url
    yield 1.0
    press("ESC", *middle())
    yield 1.0
    drop()
    yield DRAWN
    screenshot("install_drop")
    yield from confirm()
    yield DRAWN
    screenshot("install_add")
    yield from confirm()  # leaves the field
    yield 2.0
    yield from confirm()
    yield from wait_until(is_added, 60.0)
    drop()
    yield 3 * DRAWN  # Blender reads the repository first
    screenshot("install_again")
    yield from confirm()
    yield from wait_until(is_enabled, 60.0)
    scenes.ear()
    view()[1].spaces.active.show_region_ui = True
    with in_view():
        bpy.ops.view3d.view_selected()
    yield 1.0
    open_tab()
    yield DRAWN
    screenshot("install_used")


assert not [module for module in addon_utils.modules() if module.__name__.endswith("intrinsic_fairing")]
play(story)
