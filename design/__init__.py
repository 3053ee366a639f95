"""What is decided: cases, published claims, the command line. Knows every other package; none knows it."""
