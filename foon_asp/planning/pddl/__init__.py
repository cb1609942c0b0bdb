"""PDDL: written, and plans read back."""
