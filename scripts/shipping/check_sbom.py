"""Checks a bill of materials against CycloneDX's schema; exits with 1 and the reason where it differs."""

import sys
from pathlib import Path

from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator

for path in sys.argv[1:]:
    problem = JsonStrictValidator(SchemaVersion.V1_5).validate_str(Path(path).read_text(encoding="utf-8"))
    if problem:
        sys.exit(f"{path}: {problem}")
    print(f"{path} is CycloneDX 1.5")
