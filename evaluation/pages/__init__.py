"""Pages: the report of a comparison, the sheet of a car, the summary."""
