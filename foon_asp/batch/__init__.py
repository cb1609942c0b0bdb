"""Many queries: a file of them, what answers them here or on a cluster, and a journal of what is done."""
