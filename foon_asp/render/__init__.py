"""Writing answers: as text for people, as JSON for programs, as FOON text for other FOON programs."""
