"""The car that drives freely: the numbers that describe it to compiled code, their check, and its motion."""
