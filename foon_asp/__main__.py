"""`python -m foon_asp` is `foon-asp`."""

import sys

from foon_asp.cli import main

sys.exit(main())
