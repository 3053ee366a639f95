"""One wheel with a corner of the body above it."""
