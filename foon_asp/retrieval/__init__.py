"""Task trees, and everything asked about them."""
