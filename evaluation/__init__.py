"""What runs mean: numbers, plots, pages, animation."""
