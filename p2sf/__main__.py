"""``python -m p2sf`` is the command ``p2sf``."""

import sys

from p2sf.cli import main

sys.exit(main())
