"""What is decided: cases, published claims, the command line. Knows every other package; none knows it."""

import susp_mj as susp_mj  # first: from here on, who misses a package that a user's file hides is told so
