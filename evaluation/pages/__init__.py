"""Pages: the report of a comparison, the sheet of a car, the verdict of a design cycle, the summary."""
