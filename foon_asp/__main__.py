"""`python -m foon_asp` is `foon-asp`."""

from foon_asp.cli.start import main

main()
