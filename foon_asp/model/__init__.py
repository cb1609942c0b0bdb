"""What a FOON is: plain data and graph search; no files, no JSON, no solver."""
