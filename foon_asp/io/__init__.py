"""Files: read with one clear error each, and written whole or not at all."""
