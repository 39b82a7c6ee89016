"""python -m fairing: fill, fair, round and measure meshes in files."""

import sys

from fairing.command.batch import main

if __name__ == "__main__":  # not in the processes that --jobs starts
    sys.exit(main())
