"""The drill: hostile inputs, damaged stores, kills, full disks; see docs/reliability.md.

`python -m drill` with tests/ on the path runs all of it, as `make drill` does.
"""
