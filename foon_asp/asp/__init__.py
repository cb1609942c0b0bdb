"""The only floor that knows clingo."""
