"""Import this, and modules of the add-on that need no Blender can be imported: `addon.arrays.region`.

The add-on's own `__init__` would register everything.
"""

import sys
from pathlib import Path
from types import ModuleType

_package = ModuleType("addon")
_package.__path__ = [str(Path(__file__).parents[1] / "addon")]
sys.modules.setdefault("addon", _package)
