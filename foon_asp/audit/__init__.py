"""What is doubtful in FOON files."""
