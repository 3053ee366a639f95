"""Published results to reproduce: each claim of the thesis beside what comes out here."""
