"""Start the explorer: ``python -m p2sf_explorer``, and the program of the bundle."""

import sys

from p2sf_explorer.application.main import run

if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
