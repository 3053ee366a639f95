"""Verification: the product against equations and numbers that share no code with it."""
