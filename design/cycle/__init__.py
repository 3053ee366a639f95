"""The design cycle: targets in, candidates tried and repaired, the kept springs, dampers and bars out."""
