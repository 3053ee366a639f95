"""Plots of a comparison as SVG text, one module for each kind of axis."""
