"""Plans, in which objects are used up."""
